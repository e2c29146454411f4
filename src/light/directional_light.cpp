// SPDX-License-Identifier: Apache-2.0
#include "light/directional_light.h"

#include "light/importance.h"

namespace brume {

DirectionalLight::DirectionalLight(const Vec3& direction, const Rgb& irradiance)
    : to_light_(-glm::normalize(direction)), irradiance_(irradiance) {}

std::optional<LightSample> DirectionalLight::sample(const Vec3& /*p*/, const Vec2& /*u*/) const {
  return LightSample{
      .d = to_light_, .distance = kInfinity, .weight = irradiance_, .pdf = kInfinity};
}

float DirectionalLight::importance(const Vec3& /*p*/) const {
  return finite(luminance(irradiance_));
}

}  // namespace brume
