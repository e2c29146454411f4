// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "core/box.h"
#include "core/ray.h"
#include "core/vec.h"

namespace brume {

using Vec2d = glm::dvec2;
using Vec3d = glm::dvec3;
using Mat3d = glm::dmat3;

/// A float ray in double. Surfaces are intersected in double, so that what remains of rounding is
/// that of the rays and points themselves, which is known.
struct PreciseRay {
  Vec3d o;  // [unit]
  Vec3d d;  // unit, to the rounding of float

  Vec3d at(double t) const { return o + t * d; }
};

/// Step along the unit normal `n` after which a ray that leaves the rounded point `p` of a surface
/// certainly starts beyond it and stays there, on a face of diameter `extent` [unit]. It bounds
/// the distance of `p` from the surface, too.
///
/// With u = 2^-24, rounding each coordinate of the point moves it by u sum |n_i p_i| along n, and
/// so does rounding the sum p + error n in `Hit::leave`. A direction whose dot product with n is
/// computed as 0 may sink by 5 u per unit: 3 u from the dot product, the rest from the rounding of
/// n (Higham 2002, section 3.1). What is left over covers the terms in u times the result.
inline float surface_error(const Vec3& p, const Vec3& n, double extent) {
  constexpr double kRoundoff = 0x1p-24;
  const double along_n = glm::dot(glm::abs(Vec3d(n)), glm::abs(Vec3d(p)));
  return static_cast<float>(kRoundoff * (2.5 * along_n + 6.0 * extent));
}

/// How far a point of a face keeps from the edges of the face, as a multiple of its error. A point
/// nearer than its rounding to an edge may be rounded to beyond the neighbouring face, and a ray
/// that leaves it inward then escapes from a closed surface.
inline constexpr double kEdgeMargin = 2.0;

/// Smallest float box that holds the double one.
inline Box3 rounded_outward(const Vec3d& min, const Vec3d& max) {
  Box3 box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::nextafter(static_cast<float>(min[i]), -kInfinity);
    box.max[i] = std::nextafter(static_cast<float>(max[i]), kInfinity);
  }
  return box;
}

/// Both t, in order, at which o + t d has the length `radius`, for vectors of any dimension:
/// a sphere around the origin, or the circle of a cylinder. Nothing if there are none or d = 0.
/// Free of cancellation (Haines et al. 2019, Ray Tracing Gems, chapter 7).
template <typename Vec>
std::optional<std::pair<double, double>> crossings_of_ball(const Vec& o, const Vec& d,
                                                           double radius) {
  const double a = glm::dot(d, d);
  const double b = -glm::dot(o, d);
  const Vec closest = o + (b / a) * d;
  const double discriminant = radius * radius - glm::dot(closest, closest);
  if (!(discriminant >= 0.0)) return std::nullopt;
  const double length = glm::length(o);
  const double q = b + std::copysign(std::sqrt(a * discriminant), b);
  const double t0 = q / a;
  const double t1 = q != 0.0 ? (length - radius) * (length + radius) / q : 0.0;
  return std::minmax({t0, t1});
}

}  // namespace brume
