// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light.h"

namespace brume {

/// Emits the same in every direction from one point.
class PointLight final : public Light {
 public:
  /// `intensity` [W/sr].
  PointLight(const Vec3& position, const Rgb& intensity)
      : position_(position), intensity_(intensity) {}

  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  /// Uniform in direction.
  std::optional<EmittedLight> emit(const Vec2& u_point, const Vec2& u_direction) const override;
  float importance(const Vec3& p) const override;
  std::optional<Pivot> pivot() const override;

 private:
  Vec3 position_;  // [unit]
  Rgb intensity_;  // [W/sr]
};

}  // namespace brume
