// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light.h"

namespace brume {

/// Parallel light from infinitely far away; never seen directly.
class DirectionalLight final : public Light {
 public:
  /// `direction` of travel, not zero; `irradiance` [W/m^2] of a surface across it.
  DirectionalLight(const Vec3& direction, const Rgb& irradiance);

  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  float importance(const Vec3& p) const override;

 private:
  Vec3 to_light_;   // unit
  Rgb irradiance_;  // [W/m^2]
};

}  // namespace brume
