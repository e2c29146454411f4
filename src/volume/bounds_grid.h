// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/huge_pages.h"
#include "core/ray.h"
#include "volume/grid.h"

namespace brume {

/// Smallest and largest value that interpolation can return inside a cell; of an Rgb grid, over
/// the channels too.
struct ValueRange {
  float min = 0.0f;
  float max = 0.0f;
};

/// Bounds of a grid: a coarse lattice of cubic cells over the grid's box. The range of a cell
/// covers every voxel that interpolation inside the cell, faces included, can touch; it is exact,
/// so that the cells of a constant grid have equal ends.
class BoundsGrid {
 public:
  /// Cells are `cell_size` voxels wide; it is doubled until there are at most `kMaxCells`.
  template <class Value>
  explicit BoundsGrid(const Grid<Value>& grid, float cell_size = 4.0f);

  const ValueRange& range(const glm::ivec3& cell) const {
    return ranges_[(std::size_t(cell.z) * resolution_.y + cell.y) * resolution_.x + cell.x];
  }
  /// Asks memory for the ranges of some `count` cells along `ray`, the first one left out.
  void prefetch(const glm::dmat4& index_from_world, const Ray& ray, int count) const;
  /// Part of index space that the cell covers [voxels].
  Box3 cell_box(const glm::ivec3& cell) const {
    const Vec3 lo = box_.min + Vec3(cell) * cell_size_;
    return {lo, glm::min(lo + cell_size_, box_.max)};
  }

  const Box3& box() const { return box_; }
  const glm::ivec3& resolution() const { return resolution_; }
  float cell_size() const { return cell_size_; }
  /// Over all cells.
  const ValueRange& total() const { return total_; }
  std::size_t memory_bytes() const { return ranges_.size() * sizeof(ValueRange); }

 private:
  static constexpr std::size_t kMaxCells = std::size_t(1) << 22;

  Box3 box_;         // [voxels]
  float cell_size_;  // [voxels]
  glm::ivec3 resolution_;
  HugePageVector<ValueRange> ranges_;  // [z][y][x], x fastest
  ValueRange total_;
};

/// Bounds of one cell of a `BoundsGrid`, half a voxel wide each and found when asked for: inside
/// such a part interpolation touches eight voxels only, so that where all are empty it is known.
template <class Value>
class FineBounds {
 public:
  FineBounds(const Grid<Value>& grid, const Box3& cell_box)
      : grid_(grid),
        box_(cell_box),
        resolution_(glm::max(glm::ivec3(glm::ceil(box_.size() / kSize)), glm::ivec3(1))) {}

  ValueRange range(const glm::ivec3& part) const;
  Box3 cell_box(const glm::ivec3& part) const {
    const Vec3 lo = box_.min + Vec3(part) * kSize;
    return {lo, glm::min(lo + kSize, box_.max)};
  }
  const Box3& box() const { return box_; }
  const glm::ivec3& resolution() const { return resolution_; }
  float cell_size() const { return kSize; }

 private:
  static constexpr float kSize = 0.5f;  // [voxels]

  const Grid<Value>& grid_;
  Box3 box_;  // [voxels]
  glm::ivec3 resolution_;
};

/// The part of a ray inside the box of a grid, in index space: points are o + t d for t in
/// [0, t_end), where t = 0 is `t_start` along the original ray and t has the ray's unit.
struct IndexSegment {
  Vec3 o;         // [voxels]
  Vec3 d;         // [voxels/unit]
  float t_start;  // [unit]
  float t_end;    // [unit]
};

/// Clips `ray` to the box of `bounds`; nothing when they do not meet before `t_max`. The origin
/// is moved to the box in double, so that a far camera costs no precision.
std::optional<IndexSegment> clip_to_grid(const Ray& ray, float t_max, const BoundsGrid& bounds,
                                         const glm::dmat4& index_from_world);

/// Calls `visit(cell, t0, t1)` for each cell along the segment, in order, until it returns false
/// (Amanatides and Woo 1987). Plane distances come from the integer cell index, not from a running
/// sum, so nothing drifts; t1 of a cell is t0 of the next. `bounds` is a BoundsGrid or FineBounds.
template <class Bounds, class Visit>
void walk_cells(const Bounds& bounds, const IndexSegment& segment, Visit&& visit) {
  const float scale = 1.0f / bounds.cell_size();
  const Vec3 o = (segment.o - bounds.box().min) * scale;
  const Vec3 d = segment.d * scale;
  const Vec3 inverse = 1.0f / d;

  glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(o)), glm::ivec3(0), bounds.resolution() - 1);
  glm::ivec3 step, end;
  Vec3 t_plane;  // where the ray leaves the cell on each axis
  const auto plane = [&](int axis) {
    if (step[axis] == 0) return kInfinity;
    return (float(cell[axis] + (step[axis] > 0)) - o[axis]) * inverse[axis];
  };
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = d[axis] > 0.0f ? 1 : d[axis] < 0.0f ? -1 : 0;
    end[axis] = step[axis] > 0 ? bounds.resolution()[axis] : -1;
    t_plane[axis] = plane(axis);
  }

  float t0 = 0.0f;
  while (true) {
    const int axis =
        t_plane.x < t_plane.y ? (t_plane.x < t_plane.z ? 0 : 2) : (t_plane.y < t_plane.z ? 1 : 2);
    const float t1 = std::clamp(t_plane[axis], t0, segment.t_end);
    if (t1 > t0 && !visit(cell, t0, t1)) return;
    if (t_plane[axis] >= segment.t_end) return;
    cell[axis] += step[axis];
    if (cell[axis] == end[axis]) return;
    t_plane[axis] = plane(axis);
    t0 = t1;
  }
}

}  // namespace brume
