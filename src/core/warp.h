// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/vec.h"

namespace brume {

/// Unit disk, area measure (Shirley and Chiu 1997, concentric map). Density 1/pi.
inline Vec2 sample_disk(const Vec2& u) {
  const Vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0.0f && p.y == 0.0f) return {0.0f, 0.0f};
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float r = wide ? p.x : p.y;
  const float phi = wide ? kPi / 4.0f * (p.y / p.x) : kPi / 2.0f - kPi / 4.0f * (p.x / p.y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Hemisphere around +Z with density cos(theta) / pi [1/sr].
inline Vec3 sample_cosine_hemisphere(const Vec2& u) {
  const Vec2 p = sample_disk(u);
  return {p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y))};
}

/// Unit direction at `cos_theta` from +Z and azimuth `phi` [rad]; `sin_theta` is passed because
/// near the poles it cannot be recovered from the cosine.
inline Vec3 spherical_direction(float sin_theta, float cos_theta, float phi) {
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

/// Whole sphere with density 1/(4 pi) [1/sr].
inline Vec3 sample_uniform_sphere(const Vec2& u) {
  const float z = 1.0f - 2.0f * u.x;
  return spherical_direction(2.0f * std::sqrt(std::max(0.0f, u.x * (1.0f - u.x))), z,
                             2.0f * kPi * u.y);
}

/// Barycentric weights (b1, b2) of a point uniform over a triangle.
inline Vec2 sample_triangle(const Vec2& u) {
  const float root = std::sqrt(u.x);
  return {1.0f - root, u.y * root};
}

/// Power heuristic with exponent 2 (Veach 1997, eq. 9.15) of a sample with density `pdf` against
/// one other technique with density `pdf_other`, in the same measure. Safe for infinite densities.
inline float power_heuristic(float pdf, float pdf_other) {
  if (!(pdf > 0.0f)) return 0.0f;
  const float ratio = pdf_other / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace brume
