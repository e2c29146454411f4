// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "geometry/hit.h"
#include "geometry/shape.h"
#include "light/light.h"

namespace brume {

/// A surface that emits the same radiance from every point into every direction on the side of
/// its normal, and nothing from the other side.
class AreaLight final : public Light {
 public:
  /// `radiance` [W/(m^2 sr)].
  AreaLight(std::shared_ptr<const Shape> shape, const Rgb& radiance);

  /// The shadow ray of length `distance` ends in front of the surface by its error bound.
  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  /// Uniform over the shape, and by the cosine over the hemisphere of its normal.
  std::optional<EmittedLight> emit(const Vec2& u_point, const Vec2& u_direction) const override;
  float importance(const Vec3& p) const override;
  std::optional<Pivot> pivot() const override;

  /// Emitted against the direction of travel `d` of a ray that found `hit` on the light's shape.
  Rgb radiance(const Hit& hit, const Vec3& d) const {
    return glm::dot(d, hit.n) < 0.0f ? radiance_ : Rgb{0.0f};
  }
  /// Density of `sample` from `from` for the direction to `hit`, which shows the emitting side
  /// [1/sr].
  float pdf(const Vec3& from, const Hit& hit) const { return shape_->pdf_toward(from, hit); }

 private:
  std::shared_ptr<const Shape> shape_;
  Rgb radiance_;  // [W/(m^2 sr)]
  Vec3 center_;   // of the shape's bounds [unit]
  float radius_;  // of a disk of half the shape's area [unit]
};

}  // namespace brume
