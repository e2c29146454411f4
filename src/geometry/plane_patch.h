// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/precise.h"

namespace brume {

/// A plane with two axes, of which a shape covers a part: `center` + x `a` + y `b`.
struct PlanePatch {
  Vec3d center, a, b;    // [unit]
  Vec3d a_dual, b_dual;  // x = dot(p - center, a_dual), and y likewise [1/unit]
  Vec3d cross;           // a x b [unit^2]
  Vec3 n;                // unit, on the outside

  /// Takes the local plane z = 0 to the world. The outside is local +Z, wherever the transform
  /// takes it.
  PlanePatch(const glm::dmat4& to_world, bool flip_normals);

  Vec3d at(const Vec2d& xy) const { return center + xy.x * a + xy.y * b; }
  Vec2d local(const Vec3d& p) const {
    return {glm::dot(p - center, a_dual), glm::dot(p - center, b_dual)};
  }

  /// Where the ray meets the plane for t in (0, t_max].
  struct Crossing {
    double t;
    Vec2d xy;
  };
  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const {
    const double t = glm::dot(cross, center - ray.o) / glm::dot(cross, ray.d);
    if (!(t > 0.0 && t <= t_max)) return std::nullopt;
    return Crossing{.t = t, .xy = local(ray.at(t))};
  }
};

}  // namespace brume
