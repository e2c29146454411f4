// SPDX-License-Identifier: Apache-2.0
#include "light/area_light.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "light/importance.h"
#include "light/toward.h"

namespace brume {

AreaLight::AreaLight(std::shared_ptr<const Shape> shape, const Rgb& radiance)
    : shape_(std::move(shape)), radiance_(radiance) {
  assert(shape_ != nullptr);
  center_ = shape_->bounds().center();
  radius_ = std::sqrt(shape_->area() / (2.0f * kPi));
}

std::optional<LightSample> AreaLight::sample(const Vec3& p, const Vec2& u) const {
  const std::optional<ShapeSample> s = shape_->sample_toward(p, u);
  if (!s) return std::nullopt;

  // The end of the shadow ray is o + distance d. Rounding both factors to float moves it across
  // the surface by up to (sqrt(3) + 1) 2^-24 distance, and as much again if the ray is aimed anew
  // from beside `p`. That comes on top of the rounding of s.p.
  constexpr double kRounding = 0x1p-21;
  const glm::dvec3 from(p), n(s->n), on_surface(s->p);
  const double gap =
      rounding_error(s->p, s->n, s->error) + kRounding * glm::length(on_surface - from);
  const glm::dvec3 target = on_surface + gap * n;
  if (!(glm::dot(from - target, n) > 0.0)) return std::nullopt;

  const Toward toward(from, target);
  return LightSample{.d = toward.d,
                     .distance = static_cast<float>(toward.distance),
                     .weight = radiance_ / s->pdf,
                     .pdf = s->pdf};
}

float AreaLight::importance(const Vec3& p) const {
  // The solid angle of a disk of the light's size, seen from straight ahead.
  const float d2 = length_squared(center_ - p);
  const float sin2 = d2 > 0.0f ? radius_ * radius_ / (d2 + radius_ * radius_) : 1.0f;
  const float one_minus_cos = sin2 / (1.0f + std::sqrt(1.0f - sin2));
  return finite(luminance(radiance_) * 2.0f * kPi * one_minus_cos);
}

std::optional<Light::Pivot> AreaLight::pivot() const {
  return Pivot{.center = center_,
               .radius = radius_,
               .intensity = finite(luminance(radiance_) * kPi * radius_ * radius_)};
}

}  // namespace brume
