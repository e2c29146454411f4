// SPDX-License-Identifier: Apache-2.0
#include "volume/bounds_grid.h"

#include <cmath>
#include <glm/vec4.hpp>

#include "volume/packed_grid.h"

namespace brume {
namespace {

ValueRange range_of(float v) {
  return {v, v};
}
ValueRange range_of(const Rgb& v) {
  return {min_component(v), max_component(v)};
}

void extend(ValueRange& range, const ValueRange& other) {
  range.min = std::min(range.min, other.min);
  range.max = std::max(range.max, other.max);
}

/// Range over the voxels lo..hi, ends included. Whole tiles and empty nodes are read once: the
/// accessor tells how far the value at a voxel reaches.
template <class Value>
ValueRange range_over_voxels(typename Grid<Value>::NanoGrid::AccessorType& accessor,
                             const glm::ivec3& lo, const glm::ivec3& hi) {
  ValueRange range{kInfinity, -kInfinity};
  glm::ivec3 i = lo;
  for (i.z = lo.z; i.z <= hi.z; ++i.z)
    for (i.y = lo.y; i.y <= hi.y; ++i.y)
      for (i.x = lo.x; i.x <= hi.x;) {
        const nanovdb::Coord ijk(i.x, i.y, i.z);
        if (accessor.probeLeaf(ijk) == nullptr) {
          // Outside leaves a value is constant over its 8^3 block at least.
          extend(range, range_of(detail::from_nano(accessor.getValue(ijk))));
          i.x = (i.x | 7) + 1;
        } else {
          extend(range, range_of(detail::from_nano(accessor.getValue(ijk))));
          ++i.x;
        }
      }
  return range;
}

/// Range over the voxels that interpolation inside `box`, faces included, can touch.
template <class Value>
ValueRange range_inside(const Grid<Value>& grid,
                        typename Grid<Value>::NanoGrid::AccessorType& accessor, const Box3& box) {
  const float reach = grid.interpolation() == Interpolation::kNearest ? 0.5f : 0.0f;
  const glm::ivec3 lo(glm::floor(box.min + reach));
  const glm::ivec3 hi(reach > 0.0f ? glm::floor(box.max + reach) : glm::ceil(box.max));
  return range_over_voxels<Value>(accessor, lo, hi);
}

}  // namespace

template <class Value>
BoundsGrid::BoundsGrid(const Grid<Value>& grid, float cell_size)
    : box_(grid.box()), cell_size_(cell_size) {
  const auto cells_along = [&] {
    return glm::max(glm::ivec3(glm::ceil(box_.size() / cell_size_)), glm::ivec3(1));
  };
  resolution_ = cells_along();
  while (double(resolution_.x) * resolution_.y * resolution_.z > double(kMaxCells)) {
    cell_size_ *= 2.0f;
    resolution_ = cells_along();
  }

  ranges_.reserve(std::size_t(resolution_.x) * resolution_.y * resolution_.z);
  auto accessor = grid.nano().getAccessor();
  total_ = {kInfinity, -kInfinity};
  glm::ivec3 cell;
  for (cell.z = 0; cell.z < resolution_.z; ++cell.z)
    for (cell.y = 0; cell.y < resolution_.y; ++cell.y)
      for (cell.x = 0; cell.x < resolution_.x; ++cell.x) {
        const ValueRange range = range_inside(grid, accessor, cell_box(cell));
        extend(total_, range);
        ranges_.push_back(range);
      }
}

void BoundsGrid::prefetch(const glm::dmat4& index_from_world, const Ray& ray, int count) const {
  const Vec3 o(index_from_world * glm::dvec4(ray.o, 1.0));
  const Vec3 d(glm::dmat3(index_from_world) * glm::dvec3(ray.d));
  const Vec3 in_cells = (o - box_.min) / cell_size_, step = glm::normalize(d);
  for (int i = 1; i <= count; ++i) {
    const glm::ivec3 cell(in_cells + float(i) * step);
    __builtin_prefetch(&range(glm::clamp(cell, glm::ivec3(0), resolution_ - 1)));
  }
}

template <class Value>
ValueRange FineBounds<Value>::range(const glm::ivec3& part) const {
  auto accessor = grid_.nano().getAccessor();
  return range_inside(grid_, accessor, cell_box(part));
}

template BoundsGrid::BoundsGrid(const Grid<float>&, float);
template BoundsGrid::BoundsGrid(const Grid<Rgb>&, float);
template BoundsGrid::BoundsGrid(const Grid<Packed16>&, float);
template BoundsGrid::BoundsGrid(const Grid<Packed8>&, float);
template class FineBounds<float>;
template class FineBounds<Rgb>;
template class FineBounds<Packed16>;
template class FineBounds<Packed8>;

std::optional<IndexSegment> clip_to_grid(const Ray& ray, float t_max, const BoundsGrid& bounds,
                                         const glm::dmat4& index_from_world) {
  const glm::dvec3 o(index_from_world * glm::dvec4(ray.o, 1.0));
  const glm::dvec3 d(glm::dmat3(index_from_world) * glm::dvec3(ray.d));
  double t0 = 0.0;
  double t1 = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = bounds.box().min[axis] - o[axis];
    const double hi = bounds.box().max[axis] - o[axis];
    if (d[axis] == 0.0) {
      if (lo > 0.0 || hi < 0.0) return std::nullopt;
      continue;
    }
    const double a = lo / d[axis];
    const double b = hi / d[axis];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  if (!(t0 < t1)) return std::nullopt;
  return IndexSegment{
      .o = Vec3(o + t0 * d), .d = Vec3(d), .t_start = float(t0), .t_end = float(t1 - t0)};
}

}  // namespace brume
