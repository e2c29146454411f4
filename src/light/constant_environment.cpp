// SPDX-License-Identifier: Apache-2.0
#include "light/constant_environment.h"

#include "core/warp.h"

namespace brume {

std::optional<LightSample> ConstantEnvironment::sample(const Vec3& /*p*/, const Vec2& u) const {
  return LightSample{.d = sample_uniform_sphere(u),
                     .distance = kInfinity,
                     .weight = radiance_ * (4.0f * kPi),
                     .pdf = 1.0f / (4.0f * kPi)};
}

EnvironmentLight::View ConstantEnvironment::view(const Vec3& /*d*/) const {
  return {.L = radiance_, .pdf = 1.0f / (4.0f * kPi)};
}

float ConstantEnvironment::importance(const Vec3& /*p*/) const {
  return 0.0f;
}

}  // namespace brume
