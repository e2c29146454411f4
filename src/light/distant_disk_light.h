// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/frame.h"
#include "light/environment_light.h"

namespace brume {

/// A disk of constant radiance at infinity, such as the sun.
class DistantDiskLight final : public EnvironmentLight {
 public:
  /// `direction` of travel of its light, not zero; `irradiance` [W/m^2] of a surface across it.
  /// `angular_radius` [rad] lies in [1e-3, pi/2]: a smaller disk is not resolved by directions in
  /// float, and a DirectionalLight serves.
  DistantDiskLight(const Vec3& direction, float angular_radius, const Rgb& irradiance);

  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  float importance(const Vec3& p) const override;
  View view(const Vec3& d) const override;

 private:
  Frame frame_;          // +Z toward the centre of the disk
  float one_minus_cos_;  // of the angular radius
  float pdf_;            // 1 / solid angle [1/sr]
  Rgb radiance_;         // [W/(m^2 sr)]
};

}  // namespace brume
