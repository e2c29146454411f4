// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/ray.h"
#include "core/vec.h"

namespace brume {

/// The part of the `error` of a point `p` with unit normal `n`, see surface_error(), that is the
/// rounding of `p` and of a step from it. The rest is for directions within rounding of the
/// surface, which sink by a share of its extent; a small part of it stands for surfaces through the
/// origin, which are intersected in double.
inline float rounding_error(const Vec3& p, const Vec3& n, float error) {
  return std::min(0x1p-24f * 3.0f * glm::dot(glm::abs(n), glm::abs(p)) + 0x1p-20f * error, error);
}

/// A point of a shape.
struct SurfacePoint {
  Vec3 p;       // on the shape, to within `error` [unit]
  Vec3 n;       // unit geometric normal there, on the side that the shape declares as outside
  float error;  // how far any ray must step along `n` to leave [unit]; surface_error()

  /// Ray that leaves the point in direction `d`, moved off the surface by the error bound and no
  /// more, so that it neither finds the surface again nor loses optical depth.
  Ray leave(const Vec3& d) const {
    // Only a direction within rounding of the surface can sink, by a share of the surface's extent,
    // which may be thousands of times the thickness of what lies behind.
    constexpr float kGrazing = 0x1p-20f;
    const float cosine = glm::dot(d, n);
    const float step = std::abs(cosine) < kGrazing ? error : rounding_error(p, n, error);
    return {.o = cosine >= 0.0f ? p + step * n : p - step * n, .d = d};
  }

  /// Where a shadow ray from `from` ends that is not to find the surface there: before the point,
  /// on the side of `from`.
  glm::dvec3 end_of_ray_from(const Vec3& from) const {
    // The end of a ray is o + distance d. Rounding both factors to float moves it across the
    // surface by up to (sqrt(3) + 1) 2^-24 distance, and as much again if the ray is aimed anew
    // from beside `from`. That comes on top of the rounding of `p`.
    constexpr double kRounding = 0x1p-21;
    const glm::dvec3 way = glm::dvec3(from) - glm::dvec3(p);
    const double gap = rounding_error(p, n, error) + kRounding * glm::length(way);
    return glm::dvec3(p) + (glm::dot(way, glm::dvec3(n)) >= 0.0 ? gap : -gap) * glm::dvec3(n);
  }
};

/// A point on a surface, as a ray found it.
struct Hit {
  float t;              // along the ray [unit], positive; to the surface itself, not to `p`
  Vec3 p;               // on the surface, to within `error` [unit]
  float error;          // how far any ray must step along `n` to leave [unit]; surface_error()
  Vec3 n;               // unit geometric normal, on the side that the shape declares as outside
  Vec3 n_shading;       // unit interpolated normal, in the hemisphere of `n`
  Vec3 dp_du;           // tangent; any length, may be zero
  Vec2 uv;              // surface parameters
  std::uint32_t shape;  // index in the order given to `RayQueries`

  /// Other shapes whose surfaces lie at the same place to within rounding, so that a ray that
  /// leaves this one leaves them as well.
  struct Coincident {
    std::uint32_t shape;
    bool faces_alike;  // whether its outside is on the side of `n`
  };
  std::array<Coincident, 3> coincident{};
  std::uint32_t coincident_count = 0;

  SurfacePoint point() const { return {.p = p, .n = n, .error = error}; }
  /// As `SurfacePoint::leave`.
  Ray leave(const Vec3& d) const { return point().leave(d); }

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
