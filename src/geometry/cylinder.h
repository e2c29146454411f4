// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/shape.h"
#include "geometry/similarity.h"

namespace brume {

/// Open tube around the segment from p0 to p1; normals point away from it. uv: azimuth / (2 pi),
/// and 0 at p0 to 1 at p1.
class Cylinder final : public Shape {
 public:
  /// `radius` [unit] and the points, which must differ, are local; `to_world` takes them to the
  /// world.
  Cylinder(const Vec3& p0, const Vec3& p1, float radius, const Similarity& to_world,
           bool flip_normals);

  Box3 bounds() const override;
  float area() const override { return static_cast<float>(area_); }
  bool is_closed() const override { return false; }
  SurfacePoint sample_area(const Vec2& u) const override;
  std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const override;
  float pdf_toward(const Vec3& from, const Hit& hit) const override;
  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const override;
  Hit hit(const PreciseRay& ray, const Crossing& crossing) const override;

 private:
  Vec3d to_local(const Vec3d& v) const { return v * axes_; }  // by the transpose
  Vec3 point(const Vec3d& outward, double z) const {
    return Vec3(base_ + axes_ * Vec3d(0.0, 0.0, z) + radius_ * outward);
  }

  Vec3d base_;              // p0 in the world [unit]
  Mat3d axes_;              // orthonormal, the last along the tube
  double radius_, length_;  // [unit]
  double area_;             // [unit^2]
  double extent_;           // of the tube [unit]
  bool flip_normals_;
};

}  // namespace brume
