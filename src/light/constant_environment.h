// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/environment_light.h"

namespace brume {

/// The same radiance from every direction.
class ConstantEnvironment final : public EnvironmentLight {
 public:
  /// `radiance` [W/(m^2 sr)].
  explicit ConstantEnvironment(const Rgb& radiance) : radiance_(radiance) {}

  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  float importance(const Vec3& p) const override;
  View view(const Vec3& d) const override;

 private:
  Rgb radiance_;  // [W/(m^2 sr)]
};

}  // namespace brume
