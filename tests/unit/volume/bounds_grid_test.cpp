// SPDX-License-Identifier: Apache-2.0
#include "volume/bounds_grid.h"

#include <gtest/gtest.h>

#include "core/warp.h"
#include "support/grids.h"

namespace brume {
namespace {

float rough(int x, int y, int z) {
  return float((x * 7919 + y * 104729 + z * 1299709) % 1009) / 1009.0f;
}

/// Calls `visit(cell, p)` with `n` points of each cell of `bounds`, sides among them.
template <class Bounds, class Visit>
void for_points_of_cells(const Bounds& bounds, int n, const Visit& visit) {
  Rng rng(3);
  glm::ivec3 cell;
  for (cell.z = 0; cell.z < bounds.resolution().z; ++cell.z)
    for (cell.y = 0; cell.y < bounds.resolution().y; ++cell.y)
      for (cell.x = 0; cell.x < bounds.resolution().x; ++cell.x)
        for (int i = 0; i < n; ++i) {
          const Box3 box = bounds.cell_box(cell);
          Vec3 p = glm::mix(box.min, box.max,
                            Vec3(rng.next_float(), rng.next_float(), rng.next_float()));
          const int axis = i / 5 % 3;
          if (i % 5 == 0) p[axis] = i % 2 ? box.min[axis] : box.max[axis];
          visit(cell, p);
        }
}

TEST(BoundsGrid, HoldsEveryInterpolatedValueOfEveryCell) {
  for (const Interpolation interpolation : {Interpolation::kTrilinear, Interpolation::kNearest}) {
    const auto grid = test::make_grid({13, 9, 6}, rough, glm::dmat4(1.0), interpolation);
    for (const float cell_size : {1.0f, 3.0f, 4.0f, 8.0f, 32.0f}) {
      const BoundsGrid bounds(*grid, cell_size);
      GridLookup<float> lookup(*grid);
      Rng rng(4);
      for_points_of_cells(bounds, 50, [&](const glm::ivec3& cell, const Vec3& p) {
        const bool nearest = interpolation == Interpolation::kNearest;
        const float v = nearest ? lookup.nearest(p) : lookup.stochastic(p, rng);
        EXPECT_LE(v, bounds.range(cell).max);
        EXPECT_GE(v, bounds.range(cell).min);
        if (!nearest) {
          EXPECT_LE(lookup.trilinear(p), bounds.range(cell).max * 1.000001f);
        }
      });
    }
  }
}

TEST(FineBounds, HoldEveryInterpolatedValueOfTheirParts) {
  for (const Interpolation interpolation : {Interpolation::kTrilinear, Interpolation::kNearest}) {
    const auto grid = test::make_grid({13, 9, 6}, rough, glm::dmat4(1.0), interpolation);
    const BoundsGrid bounds(*grid, 4);
    const Box3 cell_box = bounds.cell_box({2, 1, 1});
    const FineBounds<float> parts(*grid, cell_box);
    EXPECT_EQ(parts.cell_box(parts.resolution() - 1).max, cell_box.max);
    GridLookup<float> lookup(*grid);
    Rng rng(4);
    for_points_of_cells(parts, 20, [&](const glm::ivec3& part, const Vec3& p) {
      const float v =
          interpolation == Interpolation::kNearest ? lookup.nearest(p) : lookup.stochastic(p, rng);
      EXPECT_LE(v, parts.range(part).max);
      EXPECT_GE(v, parts.range(part).min);
    });
  }
}

TEST(FineBounds, AreEmptyWhereAllEightVoxelsAre) {
  const auto grid = test::make_grid(
      {8, 8, 8}, [](int x, int y, int z) { return x == 0 && y == 0 && z == 0 ? 1.0f : 0.0f; });
  const FineBounds<float> parts(*grid, BoundsGrid(*grid, 4).cell_box({0, 0, 0}));
  ASSERT_EQ(parts.resolution(), glm::ivec3(8));
  EXPECT_EQ(parts.range({2, 2, 2}).max, 1.0f);
  EXPECT_EQ(parts.range({3, 2, 2}).max, 0.0f);
}

struct Walk {
  const char* name;
  Vec3 o, d;
};

TEST(WalkCells, CoversTheSegmentWithoutGapsInTheCellsItCrosses) {
  const auto grid = test::make_grid({16, 8, 4}, rough);
  const BoundsGrid bounds(*grid, 2);
  std::vector<Walk> walks = {{"axis", {-1, 0.3f, 0.4f}, {1, 0, 0}},
                             {"negative zero", {0.3f, 2, 0.4f}, {-0.0f, -1, -0.0f}},
                             {"in a face plane", {-1, 0.25f, 0.5f}, {1, 0, 0}},
                             {"along an edge", {-1, 0.0f, 0.0f}, {1, 0, 0}},
                             {"diagonal through corners", {-1, -1, -1}, {1, 1, 1}},
                             {"from the far corner", {2, 2, 2}, {-1, -1, -1}},
                             {"from inside", {0.51f, 0.49f, 0.5f}, {0.2f, 0.3f, -0.9f}}};
  Rng rng(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 o = 3.0f * sample_uniform_sphere(rng.next_vec2()) + Vec3(0.5f);
    const Vec3 target(rng.next_float(), rng.next_float(), rng.next_float());
    walks.push_back({"random", o, target - o});
  }
  int met = 0;
  for (const Walk& walk : walks) {
    const Ray ray{walk.o, glm::normalize(walk.d)};
    const auto segment = clip_to_grid(ray, kInfinity, bounds, grid->index_from_world());
    if (!segment) continue;
    ++met;
    float t = 0.0f;
    walk_cells(bounds, *segment, [&](const glm::ivec3& cell, float t0, float t1) {
      EXPECT_EQ(t0, t) << walk.name;
      EXPECT_GT(t1, t0);
      const Vec3 middle = segment->o + 0.5f * (t0 + t1) * segment->d;
      const Box3 box = bounds.cell_box(cell);
      EXPECT_LE(max_abs(middle - glm::clamp(middle, box.min, box.max)), 2e-5f) << walk.name;
      t = t1;
      return true;
    });
    EXPECT_NEAR(t, segment->t_end, 1e-5f * (1.0f + segment->t_end)) << walk.name;
  }
  EXPECT_GT(met, 500);
}

TEST(WalkCells, DoesNotDriftOverAMillionVoxels) {
  const int n = 1 << 20;
  nanovdb::GridBuilder<float> builder(1.0f);
  builder.getAccessor().setValue(nanovdb::Coord(0, 0, 0), 1.0f);
  const Grid<float> grid(builder.getHandle<>(), glm::dmat4(1.0),
                         Box3{Vec3(-0.5f), Vec3(float(n) - 0.5f, 0.5f, 0.5f)},
                         Interpolation::kTrilinear, Wrap::kBackground);
  const BoundsGrid bounds(grid, 4);
  const auto segment =
      clip_to_grid({{-10, 0, 0}, {1, 0, 0}}, kInfinity, bounds, grid.index_from_world());
  ASSERT_TRUE(segment);
  int cells = 0;
  walk_cells(bounds, *segment, [&](const glm::ivec3& cell, float t0, float t1) {
    EXPECT_NEAR(t0, 4.0f * float(cell.x), 0.13f);
    EXPECT_NEAR(t1 - t0, 4.0f, 0.26f);
    ++cells;
    return true;
  });
  EXPECT_EQ(cells, n / 4);
}

TEST(ClipToGrid, KeepsPrecisionFromAfar) {
  const auto grid = test::make_grid({8, 8, 8}, rough);
  const BoundsGrid bounds(*grid, 4);
  const auto segment =
      clip_to_grid({{-1e7f, 0.5f, 0.5f}, {1, 0, 0}}, kInfinity, bounds, grid->index_from_world());
  ASSERT_TRUE(segment);
  EXPECT_NEAR(segment->o.x, -0.5f, 1e-5f);
  EXPECT_NEAR(segment->t_end, 1.0f, 1e-6f);
  EXPECT_FALSE(
      clip_to_grid({{-2, 1.5f, 0.5f}, {1, 0, 0}}, kInfinity, bounds, grid->index_from_world()));
  EXPECT_FALSE(
      clip_to_grid({{-2, 0.5f, 0.5f}, {-1, 0, 0}}, kInfinity, bounds, grid->index_from_world()));
  EXPECT_FALSE(clip_to_grid({{-2, 0.5f, 0.5f}, {1, 0, 0}}, 1.5f, bounds, grid->index_from_world()));
}

}  // namespace
}  // namespace brume
