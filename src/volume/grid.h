// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridHandle.h>

#include "core/box.h"
#include "core/rgb.h"
#include "core/rng.h"

namespace brume {

enum class Interpolation { kNearest, kTrilinear };

/// What a grid holds outside its box: the background, or its own voxels continued.
enum class Wrap { kBackground, kClamp, kRepeat, kMirror };

namespace detail {
template <class Value>
struct NanoType;
template <>
struct NanoType<float> {
  using type = float;
};
template <>
struct NanoType<Rgb> {
  using type = nanovdb::Vec3f;
};
inline float from_nano(float v) {
  return v;
}
inline Rgb from_nano(const nanovdb::Vec3f& v) {
  return {v[0], v[1], v[2]};
}
}  // namespace detail

/// A field of `Value` (float or Rgb) sampled at voxel centres, which are the integer points of
/// index space. Sparse, immutable, shared between threads.
///
///     index space    -1     0     1     2           voxel centres at integers
///                     +-----+-----+-----+
///     box          [-0.5        ...      2.5]       cell-centred data, or the reach of the
///                                                   outermost interpolation of a sparse grid
template <class Value>
class Grid {
 public:
  using NanoValue = typename detail::NanoType<Value>::type;
  using NanoGrid = nanovdb::NanoGrid<NanoValue>;

  /// `handle` holds a NanoVDB grid of this value type whose own transform is not used. `box`
  /// [voxels] is where the field is defined, see `Wrap`; when `wrap` is not kBackground, one layer
  /// of wrapped voxels around the box is stored.
  Grid(nanovdb::GridHandle<nanovdb::HostBuffer> handle, const glm::dmat4& world_from_index,
       const Box3& box, Interpolation interpolation, Wrap wrap);

  const NanoGrid& nano() const { return *nano_; }
  const glm::dmat4& world_from_index() const { return world_from_index_; }
  const glm::dmat4& index_from_world() const { return index_from_world_; }
  const Box3& box() const { return box_; }
  Interpolation interpolation() const { return interpolation_; }
  std::size_t memory_bytes() const { return handle_.size(); }

  /// `p` [voxels] moved to the point inside the box that stands for it.
  Vec3 wrapped(const Vec3& p) const;

 private:
  nanovdb::GridHandle<nanovdb::HostBuffer> handle_;
  const NanoGrid* nano_;
  glm::dmat4 world_from_index_, index_from_world_;
  Box3 box_;
  Interpolation interpolation_;
  Wrap wrap_;
};

/// Reads a grid at points of index space. Remembers the last nodes visited: make one a ray segment.
template <class Value>
class GridLookup {
 public:
  explicit GridLookup(const Grid<Value>& grid) : accessor_(grid.nano().getAccessor()) {}

  Value nearest(const Vec3& p) { return voxel(floored(p + 0.5f)); }

  Value trilinear(const Vec3& p) {
    const glm::ivec3 i = floored(p);
    const Vec3 f = p - Vec3(i);
    const auto along_x = [&](int y, int z) {
      return glm::mix(voxel({i.x, i.y + y, i.z + z}), voxel({i.x + 1, i.y + y, i.z + z}), f.x);
    };
    return glm::mix(glm::mix(along_x(0, 0), along_x(1, 0), f.y),
                    glm::mix(along_x(0, 1), along_x(1, 1), f.y), f.z);
  }

  /// One of the eight voxels around `p`, chosen with its trilinear weight: the expectation is
  /// `trilinear(p)` at an eighth of the memory traffic.
  Value stochastic(const Vec3& p, Rng& rng) {
    const glm::ivec3 i = floored(p);
    const Vec3 f = p - Vec3(i);
    return voxel({i.x + (rng.next_float() < f.x), i.y + (rng.next_float() < f.y),
                  i.z + (rng.next_float() < f.z)});
  }

 private:
  static glm::ivec3 floored(const Vec3& p) { return glm::ivec3(glm::floor(p)); }
  Value voxel(const glm::ivec3& i) {
    return detail::from_nano(accessor_.getValue(nanovdb::Coord(i.x, i.y, i.z)));
  }

  typename Grid<Value>::NanoGrid::AccessorType accessor_;
};

}  // namespace brume
