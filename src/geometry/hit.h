// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/ray.h"
#include "core/vec.h"

namespace brume {

/// A point on a surface, as a ray found it.
struct Hit {
  float t;              // along the ray [unit], positive; to the surface itself, not to `p`
  Vec3 p;               // on the surface, to within `error` [unit]
  float error;          // how far `leave` must step along `n` [unit]; see surface_error()
  Vec3 n;               // unit geometric normal, on the side that the shape declares as outside
  Vec3 n_shading;       // unit interpolated normal, in the hemisphere of `n`
  Vec3 dp_du;           // tangent; any length, may be zero
  Vec2 uv;              // surface parameters
  std::uint32_t shape;  // index in the order given to `RayQueries`

  /// Ray that leaves the point in direction `d`, moved off the surface by the error bound and no
  /// more, so that it neither finds the surface again nor loses optical depth.
  Ray leave(const Vec3& d) const {
    return {.o = glm::dot(d, n) >= 0.0f ? p + error * n : p - error * n, .d = d};
  }
};

}  // namespace brume
