// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/precise.h"

namespace brume {

/// A rectangle projected onto the unit sphere around a point, and points of it uniform in solid
/// angle (Ureña et al. 2013).
class SphericalRectangle {
 public:
  /// Rectangle of orthogonal half edges `a` and `b` [unit] around `center`, seen from `from`.
  SphericalRectangle(const Vec3d& from, const Vec3d& center, const Vec3d& a, const Vec3d& b);

  /// [sr]; 0 for a point in the plane of the rectangle.
  double solid_angle() const { return solid_angle_; }

  /// Coordinates in [-1, 1]^2 along `a` and `b` of a point uniform in solid angle, which must not
  /// be 0.
  Vec2d sample(const Vec2d& u) const;

 private:
  double half_a_, half_b_;         // lengths of the half edges [unit]
  double x0_, x1_, y0_, y1_, z0_;  // the rectangle in the frame (a, b, toward the point) [unit]
  double b0_, b1_;                 // z of the normals of the planes through the edges along x
  double k_;                       // [rad], names as in the paper
  double solid_angle_ = 0.0;
};

}  // namespace brume
