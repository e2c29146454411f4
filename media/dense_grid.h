// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <vector>

namespace brume::media {

/// A block of voxels, 0 outside. Values live at voxel centres, which are the integer points.
template <class Value>
class DenseGrid {
 public:
  explicit DenseGrid(const glm::ivec3& size, Value fill = Value(0))
      : size_(size), values_(std::size_t(size.x) * size.y * size.z, fill) {}

  const glm::ivec3& size() const { return size_; }
  bool contains(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < size_.x && y < size_.y && z < size_.z;
  }
  Value& operator()(int x, int y, int z) { return values_[index(x, y, z)]; }
  const Value& operator()(int x, int y, int z) const { return values_[index(x, y, z)]; }
  Value* data() { return values_.data(); }

  /// Calls `work(x, y, z)` once for each voxel, planes of constant z in parallel.
  template <class Work>
  void for_each(Work&& work) const {
    tbb::parallel_for(0, size_.z, [&](int z) {
      for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) work(x, y, z);
    });
  }

 private:
  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * size_.y + y) * size_.x + x;
  }

  glm::ivec3 size_;
  std::vector<Value> values_;  // [z][y][x], x fastest
};

}  // namespace brume::media
