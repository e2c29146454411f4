// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/plane_patch.h"
#include "geometry/shape.h"

namespace brume {

/// The unit disk of the plane z = 0 under any affine transform; normal along local +Z. uv: distance
/// from the center, and azimuth / (2 pi) from local +X toward +Y.
class Disk final : public Shape {
 public:
  Disk(const glm::dmat4& to_world, bool flip_normals);

  Box3 bounds() const override;
  float area() const override { return static_cast<float>(area_); }
  bool is_closed() const override { return false; }
  SurfacePoint sample_area(const Vec2& u) const override;
  std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const override;
  float pdf_toward(const Vec3& from, const Hit& hit) const override;
  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const override;
  Hit hit(const PreciseRay& ray, const Crossing& crossing) const override;

 private:
  PlanePatch patch_;
  double area_;    // [unit^2]
  double extent_;  // at least the longest diameter [unit]
};

}  // namespace brume
