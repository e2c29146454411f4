// SPDX-License-Identifier: Apache-2.0
#include "volume/packed_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grids.h"

namespace brume {
namespace {

constexpr glm::ivec3 kSize{40, 24, 16};

float bumps(int x, int y, int z) {
  return 3.0f + std::sin(0.3f * float(x)) * std::cos(0.2f * float(y)) + 0.1f * float(z);
}

/// Largest difference over the voxels that interpolation inside the box may touch.
template <class PackedScalar>
float largest_error(const Grid<float>& grid, const Grid<PackedScalar>& other) {
  auto exact = grid.nano().getAccessor();
  auto rounded = other.nano().getAccessor();
  float largest = 0.0f;
  for (int z = -1; z <= kSize.z; ++z)
    for (int y = -1; y <= kSize.y; ++y)
      for (int x = -1; x <= kSize.x; ++x) {
        const nanovdb::Coord voxel(x, y, z);
        largest = std::max(largest, std::abs(exact.getValue(voxel) - rounded.getValue(voxel)));
      }
  return largest;
}

TEST(PackedGrid, IsOffByHalfAStepOfItsBlockAtMost) {
  const auto grid = test::make_grid(kSize, bumps);
  // Blocks at the edge of the box hold the background, 0, too: a step is largest / codes.
  constexpr float kLargest = 5.6f;
  EXPECT_LE(largest_error(*grid, *packed<Packed16>(*grid)), 0.51f * kLargest / 65535.0f);
  EXPECT_LE(largest_error(*grid, *packed<Packed8>(*grid)), 0.51f * kLargest / 255.0f);
  EXPECT_GT(largest_error(*grid, *packed<Packed8>(*grid)), 0.0f);
}

TEST(PackedGrid, TakesAHalfAndAQuarterOfTheMemory) {
  const auto grid = test::make_grid({64, 64, 64}, bumps);
  const auto leaves = [](const auto& g) {
    // Less the tree above the leaves, which the size of the grid does not matter to.
    return double(g.memory_bytes()) - double(test::make_grid({1, 1, 1}, bumps)->memory_bytes());
  };
  EXPECT_NEAR(leaves(*packed<Packed16>(*grid)) / leaves(*grid), 0.5, 0.05);
  EXPECT_NEAR(leaves(*packed<Packed8>(*grid)) / leaves(*grid), 0.25, 0.06);
}

TEST(PackedGrid, IsPlacedAndInterpolatedAsBefore) {
  const auto grid = test::make_grid(kSize, bumps, glm::dmat4(2.0), Interpolation::kNearest);
  const auto small = packed<Packed16>(*grid);
  EXPECT_EQ(small->world_from_index(), grid->world_from_index());
  EXPECT_EQ(small->box().min, grid->box().min);
  EXPECT_EQ(small->box().max, grid->box().max);
  EXPECT_EQ(small->interpolation(), Interpolation::kNearest);
  const Vec3 p(11.3f, 7.8f, 5.1f);
  EXPECT_NEAR(GridLookup<Packed16>(*small).trilinear(p), GridLookup<float>(*grid).trilinear(p),
              1e-4f);
}

}  // namespace
}  // namespace brume
