// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/huge_pages.h"
#include "volume/grid.h"

namespace brume {

/// The voxels of a grid behind a dense table of its blocks of 8^3, the leaves of the tree:
///
///     table [z][y][x]  ──►  512 values of a leaf, where the grid has one
///                      ──►  512 equal values, shared by all blocks of a tile or of empty space
///
/// A lookup is two loads at places that do not depend on earlier lookups. Where the box of a grid
/// is so wide that the table would be larger than `kMaxBlocks`, lookups walk the tree.
template <class Value>
class VoxelBlocks {
 public:
  /// `grid` must outlive the blocks.
  explicit VoxelBlocks(const Grid<Value>& grid);

  /// The voxel at `i`, which interpolation inside the grid's box may touch.
  Value operator()(const glm::ivec3& i) const {
    if (table_.empty()) return detail::from_nano(tree_->getValue(nanovdb::Coord(i.x, i.y, i.z)));
    const glm::ivec3 b = (i >> 3) - first_;
    const NanoValue* const block =
        table_[(std::size_t(b.z) * resolution_.y + b.y) * resolution_.x + b.x];
    // NanoVDB's order within a leaf: z fastest.
    return detail::from_nano(block[((i.x & 7) << 6) | ((i.y & 7) << 3) | (i.z & 7)]);
  }

  /// One of the eight voxels around `p` [voxels], as `GridLookup::stochastic` chooses it.
  Value stochastic(const Vec3& p, Rng& rng) const {
    const Vec3 lower = glm::floor(p);
    const Vec3 f = p - lower;
    // Two draws of 32 bits make three numbers of 21.
    const std::uint32_t a = rng.next_uint(), b = rng.next_uint();
    constexpr float kScale = 0x1p-21f;
    const glm::ivec3 upper(float(a >> 11) * kScale < f.x, float(b >> 11) * kScale < f.y,
                           float((a & 0x7ffu) << 10 | (b & 0x3ffu)) * kScale < f.z);
    return (*this)(glm::ivec3(lower) + upper);
  }

  std::size_t memory_bytes() const {
    return table_.size() * sizeof(table_[0]) + constant_.size() * sizeof(ConstantBlock);
  }

 private:
  using NanoValue = typename Grid<Value>::NanoValue;
  using ConstantBlock = std::array<NanoValue, 512>;
  static constexpr double kMaxBlocks = 1 << 24;

  const typename Grid<Value>::NanoGrid::TreeType* tree_;
  glm::ivec3 first_;                        // [block] of the table
  glm::ivec3 resolution_;                   // [block]
  HugePageVector<const NanoValue*> table_;  // [z][y][x], x fastest
  std::vector<std::unique_ptr<const ConstantBlock>> constant_;
};

}  // namespace brume
