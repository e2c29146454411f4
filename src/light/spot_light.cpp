// SPDX-License-Identifier: Apache-2.0
#include "light/spot_light.h"

#include <cassert>
#include <cmath>

#include "core/warp.h"
#include "light/importance.h"
#include "light/toward.h"

namespace brume {
namespace {

/// Whether a matrix of determinant 1 or -1 keeps angles.
bool is_similarity(const glm::dmat3& m) {
  const glm::dmat3 squared = glm::transpose(m) * m;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (std::abs(squared[column][row] - (column == row ? 1.0 : 0.0)) > 1e-5) return false;
  return true;
}

}  // namespace

SpotLight::SpotLight(const glm::dmat4& to_world, const Rgb& intensity, float cutoff_angle,
                     float beam_width)
    : position_(to_world[3]),
      to_local_(glm::inverse(glm::dmat3(to_world))),
      to_world_(glm::dmat3(to_world) / std::cbrt(std::abs(glm::determinant(glm::dmat3(to_world))))),
      intensity_(intensity),
      cutoff_angle_(cutoff_angle),
      beam_width_(beam_width),
      pivot_{.center = position_, .radius = 0.0f, .intensity = finite(luminance(intensity))} {
  assert(0.0f <= beam_width && beam_width <= cutoff_angle && cutoff_angle <= kPi);
  // Elliptical cones are left out, and those that are wider than a half-space.
  if (is_similarity(to_world_) && cutoff_angle < 0.5f * kPi) {
    pivot_.axis = glm::normalize(Vec3(to_world_[2]));
    pivot_.cos_cutoff = std::cos(cutoff_angle);
  }
}

/// Fraction of the intensity emitted at a local `angle` from the axis.
float SpotLight::falloff(float angle) const {
  if (angle <= beam_width_) return 1.0f;
  if (angle >= cutoff_angle_) return 0.0f;
  return (cutoff_angle_ - angle) / (cutoff_angle_ - beam_width_);
}

/// Fraction of the intensity emitted along the direction of travel `d`.
float SpotLight::falloff(const Vec3& d) const {
  const Vec3 local = to_local_ * d;
  // acos() of a cosine near 1 would lose the angle of a narrow beam.
  return falloff(std::atan2(std::hypot(local.x, local.y), local.z));
}

std::optional<LightSample> SpotLight::sample(const Vec3& p, const Vec2& /*u*/) const {
  const Toward toward(p, position_);
  if (!(toward.distance > 0.0)) return std::nullopt;
  const float fraction = falloff(-toward.d);
  if (fraction == 0.0f) return std::nullopt;
  return LightSample{.d = toward.d,
                     .distance = static_cast<float>(toward.distance),
                     .weight = intensity_ * (fraction * toward.inverse_square()),
                     .pdf = kInfinity};
}

std::optional<Light::EmittedLight> SpotLight::emit(const Vec2& /*u_point*/,
                                                   const Vec2& u_direction) const {
  const float sine_of_half = std::sin(0.5f * cutoff_angle_);
  const float one_minus_cos_cutoff = 2.0f * sine_of_half * sine_of_half;
  const float one_minus_cos = u_direction.x * one_minus_cos_cutoff;
  const float cosine = 1.0f - one_minus_cos;
  const float sine = std::sqrt(one_minus_cos * (2.0f - one_minus_cos));
  const Vec3 local = spherical_direction(sine, cosine, 2.0f * kPi * u_direction.y);

  // A linear map A takes the solid angle around a unit vector v to |det A| / |A v|^3 as much.
  const glm::dvec3 way = to_world_ * glm::dvec3(local);
  const double length = glm::length(way);
  const auto stretch = static_cast<float>(1.0 / (length * length * length));
  const float solid_angle = 2.0f * kPi * one_minus_cos_cutoff;
  return EmittedLight{
      .ray = {.o = position_, .d = Vec3(way / length)},
      .power = intensity_ * (falloff(std::atan2(sine, cosine)) * solid_angle * stretch)};
}

float SpotLight::importance(const Vec3& p) const {
  const Vec3 from_light = p - position_;
  return finite(luminance(intensity_) * falloff(from_light) / length_squared(from_light));
}

}  // namespace brume
