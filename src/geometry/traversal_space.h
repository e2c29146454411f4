// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/box.h"
#include "core/ray.h"
#include "geometry/precise.h"

namespace brume {

/// Coordinates in which the scene is about one unit wide and near the origin. The hierarchy is
/// walked there in float, which overflows for scenes 1e13 wide and loses the digits of a scene
/// far from the origin.
///
/// Both steps are exact. The scale is a power of two. A coordinate is shifted only if the scene is
/// so far away in it that the difference of any two values near the scene has no rounding error
/// (Sterbenz 1974), and elsewhere not at all. So a box contains here what it contains there.
class TraversalSpace {
 public:
  explicit TraversalSpace(const Box3& scene);

  Vec3 from_world(const Vec3& p) const { return (p - shift_) * scale_; }
  Box3 from_world(const Box3& box) const { return {from_world(box.min), from_world(box.max)}; }
  /// Not less than the exact value.
  float from_world(double distance) const {
    return std::nextafter(static_cast<float>(distance * scale_), kInfinity);
  }

  /// The ray from where it comes near the scene: exactly the given one when its origin is near,
  /// otherwise one whose origin is rounded there to float. Nothing when it stays away.
  struct NearRay {
    Ray ray;   // in the world
    double t;  // of its origin along the given ray [unit]
  };
  std::optional<NearRay> near(const Ray& ray) const;

 private:
  static constexpr double kReach = 2.0;  // half width of "near", in extents of the scene

  Vec3d center_;
  double extent_;  // largest of the scene [unit]
  Vec3 shift_{0.0f};
  float scale_ = 1.0f;
};

}  // namespace brume
