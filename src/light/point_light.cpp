// SPDX-License-Identifier: Apache-2.0
#include "light/point_light.h"

#include "core/warp.h"
#include "light/importance.h"
#include "light/toward.h"

namespace brume {

std::optional<LightSample> PointLight::sample(const Vec3& p, const Vec2& /*u*/) const {
  const Toward toward(p, position_);
  if (!(toward.distance > 0.0)) return std::nullopt;
  return LightSample{.d = toward.d,
                     .distance = static_cast<float>(toward.distance),
                     .weight = intensity_ * toward.inverse_square(),
                     .pdf = kInfinity};
}

std::optional<Light::EmittedLight> PointLight::emit(const Vec2& /*u_point*/,
                                                    const Vec2& u_direction) const {
  return EmittedLight{.ray = {.o = position_, .d = sample_uniform_sphere(u_direction)},
                      .power = 4.0f * kPi * intensity_};
}

float PointLight::importance(const Vec3& p) const {
  return finite(luminance(intensity_) / length_squared(position_ - p));
}

std::optional<Light::Pivot> PointLight::pivot() const {
  return Pivot{.center = position_, .radius = 0.0f, .intensity = finite(luminance(intensity_))};
}

}  // namespace brume
