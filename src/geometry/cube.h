// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "geometry/shape.h"

namespace brume {

/// The cube [-1, 1]^3 under any invertible affine transform; normals outward, uv in [0, 1]^2 on
/// every side.
class Cube final : public Shape {
 public:
  Cube(const glm::dmat4& to_world, bool flip_normals);

  Box3 bounds() const override;
  float area() const override;
  bool is_closed() const override { return true; }
  SurfacePoint sample_area(const Vec2& u) const override;
  std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const override;
  float pdf_toward(const Vec3& from, const Hit& hit) const override;
  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const override;
  Hit hit(const PreciseRay& ray, const Crossing& crossing) const override;

 private:
  /// Sides are numbered -X, +X, -Y, +Y, -Z, +Z.
  static constexpr int kSides = 6;
  struct Side {
    Vec3 n;       // unit, on the outside
    double area;  // [unit^2]
  };
  /// Areas of some of the sides.
  struct SideAreas {
    std::array<double, kSides> area{};  // 0 for a side left out [unit^2]
    double total = 0.0;                 // [unit^2]
  };
  template <class Condition>
  SideAreas sides_where(const Condition& condition) const;
  SideAreas all_sides() const;
  /// Up to three from outside, six from inside.
  SideAreas sides_seen_from(const Vec3& from) const;
  /// A point uniform over the area of `among`, which must not be empty.
  SurfacePoint sample_area(const SideAreas& among, const Vec2& u) const;

  Vec3d center_;    // [unit]
  Mat3d to_world_;  // of vectors
  Mat3d to_local_;
  std::array<Side, kSides> sides_;
  double extent_;  // the longest diagonal of a side [unit]
};

}  // namespace brume
