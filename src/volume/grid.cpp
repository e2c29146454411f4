// SPDX-License-Identifier: Apache-2.0
#include "volume/grid.h"

#include <cassert>
#include <cmath>

#include "volume/packed_grid.h"

namespace brume {
namespace {

float wrapped_coordinate(float x, float lo, float hi, Wrap wrap) {
  if (wrap == Wrap::kClamp) return std::clamp(x, lo, hi);
  const float size = hi - lo;
  const float period = wrap == Wrap::kMirror ? 2.0f * size : size;
  float offset = std::fmod(x - lo, period);
  if (offset < 0.0f) offset += period;
  if (offset > size) offset = period - offset;  // the way back of a mirror
  return lo + offset;
}

}  // namespace

template <class Value>
Grid<Value>::Grid(nanovdb::GridHandle<nanovdb::HostBuffer> handle,
                  const glm::dmat4& world_from_index, const Box3& box, Interpolation interpolation,
                  Wrap wrap)
    : handle_(std::move(handle)),
      nano_(handle_.grid<NanoValue>()),
      world_from_index_(world_from_index),
      index_from_world_(glm::inverse(world_from_index)),
      box_(box),
      interpolation_(interpolation),
      wrap_(wrap) {
  assert(nano_ != nullptr);
  assert(!box.empty());
}

template <class Value>
Vec3 Grid<Value>::wrapped(const Vec3& p) const {
  if (wrap_ == Wrap::kBackground) return p;
  Vec3 q{0.0f};
  for (int axis = 0; axis < 3; ++axis)
    q[axis] = wrapped_coordinate(p[axis], box_.min[axis], box_.max[axis], wrap_);
  return q;
}

template class Grid<float>;
template class Grid<Rgb>;
template class Grid<Packed16>;
template class Grid<Packed8>;

}  // namespace brume
