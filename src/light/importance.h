// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "light/light.h"

namespace brume {

/// Sums of importance below it are as good as none: their reciprocals may not be finite.
constexpr float kLeastImportance = 1e-30f;

/// `importance` >= 0, or infinite beside a point light, kept where sums of it are finite.
inline float finite(float importance) {
  return std::min(importance, 1e30f);
}

/// Importance at `p` of a cluster of lights taken for one; nothing where `p` is within so many of
/// its radii.
inline std::optional<float> importance_as_one(const Light::Pivot& cluster, const Vec3& p,
                                              float radii) {
  const float d2 = length_squared(cluster.center - p);
  const float radius2 = cluster.radius * cluster.radius;
  if (d2 < radii * radii * radius2) return std::nullopt;
  return finite(cluster.intensity / (d2 + radius2));
}

}  // namespace brume
