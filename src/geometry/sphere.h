// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/shape.h"

namespace brume {

/// Sphere with outward normals. uv: azimuth / (2 pi) from the local +X toward +Y, and angle / pi
/// from the local +Z.
class Sphere final : public Shape {
 public:
  /// The orthonormal `orientation` takes local axes to the world; it only turns uv.
  Sphere(const Vec3& center, float radius, bool flip_normals,
         const glm::mat3& orientation = glm::mat3(1.0f));

  Box3 bounds() const override;
  float area() const override { return static_cast<float>(area_); }
  bool is_closed() const override { return true; }
  SurfacePoint sample_area(const Vec2& u) const override;
  std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const override;
  float pdf_toward(const Vec3& from, const Hit& hit) const override;
  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const override;
  Hit hit(const PreciseRay& ray, const Crossing& crossing) const override;

 private:
  /// Cone of directions from a point outside that meet the sphere; nothing from inside.
  struct Cone {
    Vec3d axis;                  // unit, from the center to the point
    double sin2, one_minus_cos;  // of the half-angle

    double pdf() const { return 1.0 / (2.0 * M_PI * one_minus_cos); }  // [1/sr]
  };
  std::optional<Cone> cone_from(const Vec3& from) const;

  Vec3d center_;
  double radius_;  // [unit]
  double area_;    // [unit^2]
  bool flip_normals_;
  glm::mat3 orientation_;
};

}  // namespace brume
