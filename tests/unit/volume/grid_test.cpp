// SPDX-License-Identifier: Apache-2.0
#include "volume/grid.h"

#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/statistics.h"
#include "volume/field.h"

namespace brume {
namespace {

float ramp(int x, int y, int z) {
  return float(x + 10 * y + 100 * z);
}

TEST(GridLookup, TrilinearReproducesALinearField) {
  const auto grid = test::make_grid({8, 8, 8}, ramp);
  GridLookup<float> lookup(*grid);
  EXPECT_FLOAT_EQ(lookup.trilinear({1.25f, 2.5f, 3.75f}), 1.25f + 25.0f + 375.0f);
  EXPECT_FLOAT_EQ(lookup.nearest({1.4f, 2.6f, 3.0f}), 1.0f + 30.0f + 300.0f);
}

TEST(GridLookup, StochasticHasTheExpectationOfTrilinear) {
  const auto grid = test::make_grid({4, 4, 4}, [](int x, int y, int z) { return x * y * z; });
  GridLookup<float> lookup(*grid);
  const Vec3 p(1.3f, 0.8f, 2.6f);
  Rng rng(1);
  test::RunningMean mean;
  for (int i = 0; i < 100000; ++i) mean.add(lookup.stochastic(p, rng));
  EXPECT_TRUE(test::agrees(mean, lookup.trilinear(p)));
}

TEST(GridField, FollowsItsTransform) {
  glm::dmat4 to_world(1.0);
  to_world[0][0] = 0.0;
  to_world[0][1] = 2.0;   // index x runs along world y
  to_world[1][0] = -3.0;  // index y runs along world -x
  to_world[1][1] = 0.0;
  to_world[3][2] = 5.0;
  const auto field = make_grid_field(test::make_grid({4, 4, 4}, ramp, to_world));
  // Unit cube point (0.375, 0.625, 0.125) is voxel (1, 2, 0).
  const Vec3 p = Vec3(to_world * glm::dvec4(0.375, 0.625, 0.125, 1.0));
  EXPECT_NEAR(field->value(p).r, 21.0f, 1e-4f);
}

class WrapLaw : public ::testing::TestWithParam<std::pair<Wrap, float>> {};

TEST_P(WrapLaw, ContinuesOutsideTheBox) {
  const auto [wrap, want] = GetParam();
  nanovdb::GridBuilder<float> builder(0.0f);
  const Grid<float> grid(builder.getHandle<>(), glm::dmat4(1.0), Box3{Vec3(-0.5f), Vec3(3.5f)},
                         Interpolation::kTrilinear, wrap);
  EXPECT_FLOAT_EQ(grid.wrapped(Vec3(4.25f, 1.0f, 1.0f)).x, want);
}

INSTANTIATE_TEST_SUITE_P(Modes, WrapLaw,
                         ::testing::Values(std::pair{Wrap::kBackground, 4.25f},
                                           std::pair{Wrap::kClamp, 3.5f},
                                           std::pair{Wrap::kRepeat, 0.25f},
                                           std::pair{Wrap::kMirror, 2.75f}));

}  // namespace
}  // namespace brume
