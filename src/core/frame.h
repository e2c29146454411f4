// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/vec.h"

namespace brume {

/// Right-handed orthonormal basis around the unit vector `n`, its local +Z.
struct Frame {
  Vec3 s, t, n;

  /// Branch-free construction (Duff et al. 2017, listing 3).
  explicit Frame(const Vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    s = Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    t = Vec3(b, sign + n.y * n.y * a, -n.y);
  }

  /// `s` is `tangent` made orthogonal to `normal`; any tangent when the two are parallel.
  Frame(const Vec3& normal, const Vec3& tangent) : Frame(normal) {
    const Vec3 projected = tangent - glm::dot(tangent, n) * n;
    const float squared = length_squared(projected);
    if (!(squared > 0.0f) || !std::isfinite(squared)) return;
    s = projected / std::sqrt(squared);
    t = glm::cross(n, s);
  }

  Vec3 to_local(const Vec3& v) const { return {glm::dot(v, s), glm::dot(v, t), glm::dot(v, n)}; }
  Vec3 to_world(const Vec3& v) const { return v.x * s + v.y * t + v.z * n; }
};

}  // namespace brume
