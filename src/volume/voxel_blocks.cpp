// SPDX-License-Identifier: Apache-2.0
#include "volume/voxel_blocks.h"

#include <map>

namespace brume {
namespace {

/// Order of values, so that those of tiles can be found again.
std::array<float, 3> key(float v) {
  return {v, 0.0f, 0.0f};
}
std::array<float, 3> key(const nanovdb::Vec3f& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

template <class Value>
VoxelBlocks<Value>::VoxelBlocks(const Grid<Value>& grid) : tree_(&grid.nano().tree()) {
  first_ = glm::ivec3(glm::floor(grid.box().min)) >> 3;
  resolution_ = ((glm::ivec3(glm::floor(grid.box().max)) + 1) >> 3) - first_ + 1;
  const double blocks = double(resolution_.x) * resolution_.y * resolution_.z;
  if (blocks > kMaxBlocks) return;

  table_.reserve(std::size_t(blocks));
  std::map<std::array<float, 3>, const NanoValue*> constant_of;
  auto accessor = grid.nano().getAccessor();
  glm::ivec3 b;
  for (b.z = 0; b.z < resolution_.z; ++b.z)
    for (b.y = 0; b.y < resolution_.y; ++b.y)
      for (b.x = 0; b.x < resolution_.x; ++b.x) {
        const glm::ivec3 i = (b + first_) * 8;
        const nanovdb::Coord voxel(i.x, i.y, i.z);
        if (const auto* leaf = accessor.probeLeaf(voxel)) {
          table_.push_back(leaf->data()->mValues);
          continue;
        }
        const NanoValue value = accessor.getValue(voxel);
        const NanoValue*& block = constant_of[key(value)];
        if (block == nullptr) {
          auto filled = std::make_unique<ConstantBlock>();
          filled->fill(value);
          block = filled->data();
          constant_.push_back(std::move(filled));
        }
        table_.push_back(block);
      }
}

template class VoxelBlocks<float>;
template class VoxelBlocks<Rgb>;

}  // namespace brume
