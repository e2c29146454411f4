// SPDX-License-Identifier: Apache-2.0
#include "light/area_light.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "core/frame.h"
#include "core/warp.h"
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

  const glm::dvec3 from(p);
  const glm::dvec3 target =
      SurfacePoint{.p = s->p, .n = s->n, .error = s->error}.end_of_ray_from(p);
  if (!(glm::dot(from - target, glm::dvec3(s->n)) > 0.0)) return std::nullopt;

  const Toward toward(from, target);
  return LightSample{.d = toward.d,
                     .distance = static_cast<float>(toward.distance),
                     .weight = radiance_ / s->pdf,
                     .pdf = s->pdf};
}

std::optional<Light::EmittedLight> AreaLight::emit(const Vec2& u_point,
                                                   const Vec2& u_direction) const {
  const SurfacePoint point = shape_->sample_area(u_point);
  const Vec3 d = Frame(point.n).to_world(sample_cosine_hemisphere(u_direction));
  // Rounding may put a direction along the surface behind it.
  const bool is_emitted = glm::dot(d, point.n) > 0.0f;
  return EmittedLight{.ray = point.leave(d),
                      .power = is_emitted ? radiance_ * (kPi * shape_->area()) : Rgb{0.0f}};
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
