// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "geometry/shape.h"

namespace brume {

/// Density in solid angle seen from `from` [1/sr] of a point `p` with unit normal `n` that is
/// uniform over `area`; 0 where it is infinite, that is where the surface is seen edge on.
inline float solid_angle_pdf(const Vec3& from, const Vec3& p, const Vec3& n, double area) {
  const Vec3d way = Vec3d(p) - Vec3d(from);
  const double squared = glm::dot(way, way);
  const double projected = std::abs(glm::dot(way, Vec3d(n))) * area;
  const double pdf = squared * std::sqrt(squared) / projected;
  return projected > 0.0 && std::isfinite(float(pdf)) ? static_cast<float>(pdf) : 0.0f;
}

/// The sample for a point that is uniform over `area`.
inline std::optional<ShapeSample> sample_by_area(const Vec3& from, const SurfacePoint& point,
                                                 double area) {
  const float pdf = solid_angle_pdf(from, point.p, point.n, area);
  if (pdf == 0.0f) return std::nullopt;
  return ShapeSample{.p = point.p, .n = point.n, .error = point.error, .pdf = pdf};
}

}  // namespace brume
