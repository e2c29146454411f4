// SPDX-License-Identifier: Apache-2.0
#include "volume/voxel_blocks.h"

#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/statistics.h"

namespace brume {
namespace {

/// A few leaves and a tile around the origin, far apart in a box that is `reach` voxels wide on
/// each side of it.
std::shared_ptr<const Grid<float>> sparse_grid(int reach) {
  nanovdb::GridBuilder<float> builder(0.25f);
  auto accessor = builder.getAccessor();
  for (int i = -30; i < 30; ++i) accessor.setValue(nanovdb::Coord(i, 2 * i, -i), float(i) + 100.0f);
  accessor.setValue(nanovdb::Coord(reach, reach, reach), 7.0f);
  return std::make_shared<const Grid<float>>(builder.getHandle<>(), glm::dmat4(1.0),
                                             Box3{Vec3(float(-reach)), Vec3(float(reach))},
                                             Interpolation::kTrilinear, Wrap::kBackground);
}

class VoxelBlocksLaw : public ::testing::TestWithParam<int> {};

TEST_P(VoxelBlocksLaw, HoldWhatTheTreeHolds) {
  const int reach = GetParam();
  const auto grid = sparse_grid(reach);
  const VoxelBlocks<float> voxels(*grid);
  GridLookup<float> lookup(*grid);
  for (int i = -reach; i <= reach + 1; i += std::max(1, reach / 1000))
    for (const glm::ivec3& p : {glm::ivec3(i, 2 * std::clamp(i, -20, 20), -i), glm::ivec3(i, i, i),
                                glm::ivec3(i, 0, reach)}) {
      if (!glm::all(glm::lessThanEqual(glm::abs(p), glm::ivec3(reach)))) continue;
      ASSERT_EQ(voxels(p), lookup.nearest(Vec3(p)));
    }
  for (int i = -30; i < 30; ++i) ASSERT_EQ(voxels({i, 2 * i, -i}), float(i) + 100.0f);
}

// The widest has no table.
INSTANTIATE_TEST_SUITE_P(Reaches, VoxelBlocksLaw, ::testing::Values(64, 200, 3000));

TEST(VoxelBlocks, StochasticHasTheExpectationOfTrilinear) {
  const auto grid = test::make_grid({4, 4, 4}, [](int x, int y, int z) { return x * y * z; });
  const VoxelBlocks<float> voxels(*grid);
  const Vec3 p(1.3f, 0.8f, 2.6f);
  Rng rng(1);
  test::RunningMean mean;
  for (int i = 0; i < 100000; ++i) mean.add(voxels.stochastic(p, rng));
  EXPECT_TRUE(test::agrees(mean, GridLookup<float>(*grid).trilinear(p)));
}

}  // namespace
}  // namespace brume
