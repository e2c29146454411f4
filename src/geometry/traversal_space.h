// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "core/box.h"
#include "geometry/precise.h"

namespace brume {

/// Coordinates in which a hierarchy of boxes is one unit wide and centered, and rays start near
/// it. The hierarchy is walked there in float, which in the world would overflow for scenes 1e13
/// wide, and would lose the digits of small things far from the origin.
///
/// A ray finds here every box that it meets in the world. Rays start within `kReach` = 2 of the
/// center. Placing the origin in float moves the ray by 2^-24 kReach; a slab test that computes
/// lower / d - o / d with a reciprocal accurate to two units in the last place errs by
/// 2^-24 (1/2 + kReach + 3 (1/2 + kReach)) in space. Boxes are padded by more than the sum.
class TraversalSpace {
 public:
  /// `world` is the box around everything.
  explicit TraversalSpace(const Box3& world);

  /// Padded.
  Box3 box(const Box3& world) const;

  struct LocalRay {
    Vec3 o;        // [1], with the direction of the ray in the world
    double start;  // distance of `o` from the origin of the ray [unit]
  };
  /// The ray from where it comes near; nothing when it stays away.
  std::optional<LocalRay> ray(const PreciseRay& world) const;

  /// Bound on how far rounding to float may move a point of the world's box along a ray that is not
  /// grazing a surface there [unit].
  double coordinate_rounding() const {
    const Vec3d c = glm::abs(center_);
    return 0x1p-20 * (std::max({c.x, c.y, c.z}) + 1.0 / scale_);
  }

  /// Distance from a local origin, not less than the exact value.
  float distance(double world) const {
    return std::nextafter(static_cast<float>(world * scale_), kInfinity);
  }

 private:
  static constexpr double kReach = 2.0;
  static constexpr double kPadding = 0x1p-19;

  Vec3d center_;        // [unit]
  double scale_ = 1.0;  // [1/unit]
};

}  // namespace brume
