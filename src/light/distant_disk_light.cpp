// SPDX-License-Identifier: Apache-2.0
#include "light/distant_disk_light.h"

#include <cassert>
#include <cmath>

#include "core/warp.h"
#include "light/importance.h"

namespace brume {
namespace {

float square(float x) {
  return x * x;
}

}  // namespace

DistantDiskLight::DistantDiskLight(const Vec3& direction, float angular_radius,
                                   const Rgb& irradiance)
    : frame_(-glm::normalize(direction)),
      one_minus_cos_(2.0f * square(std::sin(0.5f * angular_radius))),
      pdf_(1.0f / (2.0f * kPi * one_minus_cos_)),
      // The irradiance of a cone around the normal is pi sin^2 times its radiance.
      radiance_(irradiance / (kPi * square(std::sin(angular_radius)))) {
  assert(angular_radius >= 1e-3f && angular_radius <= 0.5f * kPi);
}

std::optional<LightSample> DistantDiskLight::sample(const Vec3& /*p*/, const Vec2& u) const {
  const float x = u.x * one_minus_cos_;
  const Vec3 local = spherical_direction(std::sqrt(x * (2.0f - x)), 1.0f - x, 2.0f * kPi * u.y);
  return LightSample{.d = glm::normalize(frame_.to_world(local)),
                     .distance = kInfinity,
                     .weight = radiance_ / pdf_,
                     .pdf = pdf_};
}

EnvironmentLight::View DistantDiskLight::view(const Vec3& d) const {
  if (one_minus_cos(d, frame_.n) > one_minus_cos_) return {.L = Rgb{0.0f}, .pdf = 0.0f};
  return {.L = radiance_, .pdf = pdf_};
}

float DistantDiskLight::importance(const Vec3& /*p*/) const {
  return finite(luminance(radiance_) / pdf_);
}

}  // namespace brume
