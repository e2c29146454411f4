// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light.h"

namespace brume {

/// Emits from the origin of its space into a cone around +Z, with the falloff of Mitsuba 3: full
/// intensity within `beam_width` of the axis, from there linear in the angle down to 0 at
/// `cutoff_angle`.
class SpotLight final : public Light {
 public:
  /// `intensity` [W/sr] is that of the beam; 0 <= `beam_width` <= `cutoff_angle` <= pi, half angles
  /// [rad]. `to_world` is affine and invertible.
  SpotLight(const glm::dmat4& to_world, const Rgb& intensity, float cutoff_angle, float beam_width);

  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  /// Uniform over the directions of the cone, as its own space sees them.
  std::optional<EmittedLight> emit(const Vec2& u_point, const Vec2& u_direction) const override;
  float importance(const Vec3& p) const override;
  std::optional<Pivot> pivot() const override { return pivot_; }

 private:
  float falloff(float angle) const;
  float falloff(const Vec3& d) const;

  Vec3 position_;  // [unit]
  glm::mat3 to_local_;
  glm::dmat3 to_world_;              // scaled to a determinant of 1 or -1
  Rgb intensity_;                    // [W/sr]
  float cutoff_angle_, beam_width_;  // [rad]
  Pivot pivot_;
};

}  // namespace brume
