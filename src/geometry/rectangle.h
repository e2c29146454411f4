// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/plane_patch.h"
#include "geometry/shape.h"
#include "geometry/spherical_rectangle.h"

namespace brume {

/// The square [-1, 1]^2 of the plane z = 0 under any affine transform; normal along local +Z,
/// uv in [0, 1]^2 along local +X and +Y.
class Rectangle final : public Shape {
 public:
  Rectangle(const glm::dmat4& to_world, bool flip_normals);

  Box3 bounds() const override;
  float area() const override { return static_cast<float>(area_); }
  bool is_closed() const override { return false; }
  SurfacePoint sample_area(const Vec2& u) const override;
  std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const override;
  float pdf_toward(const Vec3& from, const Hit& hit) const override;
  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const override;
  Hit hit(const PreciseRay& ray, const Crossing& crossing) const override;

 private:
  SurfacePoint point_at(const Vec2d& xy) const;
  /// For sampling by solid angle; nothing where area serves better.
  std::optional<SphericalRectangle> seen_from(const Vec3& from) const;

  PlanePatch patch_;
  double area_;    // [unit^2]
  double extent_;  // the longer diagonal [unit]
  bool is_right_angled_;
};

}  // namespace brume
