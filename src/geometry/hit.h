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

  /// As `leave`, for a ray that must end at the point `distance` along `d` [unit, may be infinite]:
  /// it is aimed anew from where it starts, and `distance` becomes its length.
  Ray leave_toward(const Vec3& d, float& distance) const {
    const Ray ray = leave(d);
    if (!(distance < kInfinity)) return ray;
    const glm::dvec3 target = glm::dvec3(p) + double(distance) * glm::dvec3(d);
    const glm::dvec3 to_target = target - glm::dvec3(ray.o);
    const double length = glm::length(to_target);
    distance = float(length);
    return length > 0.0 ? Ray{.o = ray.o, .d = Vec3(to_target / length)} : ray;
  }
};

}  // namespace brume
