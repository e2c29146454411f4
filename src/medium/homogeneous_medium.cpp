// SPDX-License-Identifier: Apache-2.0
#include "medium/homogeneous_medium.h"

#include <fmt/format.h>

#include <cmath>

#include "medium/channel.h"

namespace brume {

Rgb HomogeneousMedium::transmittance(float distance) const {
  // A finite distance keeps 0 * infinity out of channels without extinction.
  return glm::exp(-sigma_t_ * std::min(distance, std::numeric_limits<float>::max()));
}

Rgb HomogeneousMedium::opacity(float distance) const {
  const Rgb tau = sigma_t_ * std::min(distance, std::numeric_limits<float>::max());
  return {-std::expm1(-tau.r), -std::expm1(-tau.g), -std::expm1(-tau.b)};
}

float HomogeneousMedium::sample_distance(int channel, float u) const {
  const float sigma_t = sigma_t_[channel];
  return sigma_t > 0.0f ? -std::log1p(-u) / sigma_t : kInfinity;
}

float HomogeneousMedium::probability_of_passing(float distance, const Rgb& p_channel) const {
  return glm::dot(p_channel, transmittance(distance));
}

FreeFlight HomogeneousMedium::sample_free_flight(const Ray& /*ray*/, float t_max, const Rgb& beta,
                                                 Sampler& sampler) const {
  if (is_black(albedo_)) return {.t = t_max, .weight = transmittance(t_max)};

  // One channel proposes the distance, likeliest where the path still carries energy. Dividing by
  // the density averaged over all proposals keeps every channel unbiased (one-sample balance
  // heuristic, Veach 1997, ch. 9) and bounds beta * weight by the sum of beta.
  const Vec2 u = sampler.next_2d();
  const Rgb p_channel = normalized_or_uniform(beta);
  const float t = sample_distance(sample_channel(p_channel, u.y), u.x);
  if (!(t < t_max)) {
    const Rgb T = transmittance(t_max);
    const float p_pass = glm::dot(p_channel, T);
    return {.t = t_max, .weight = p_pass > 0.0f ? T / p_pass : Rgb{0.0f}};
  }
  return scattered_at(t, p_channel);
}

std::optional<float> HomogeneousMedium::probability_of_scattering(const Ray& /*ray*/, float t_max,
                                                                  const Rgb& beta) const {
  if (is_black(albedo_)) return 0.0f;
  return glm::dot(normalized_or_uniform(beta), opacity(t_max));
}

FreeFlight HomogeneousMedium::sample_scattering(const Ray& /*ray*/, float t_max, const Rgb& beta,
                                                Sampler& sampler) const {
  const Vec2 u = sampler.next_2d();
  const Rgb p_channel = normalized_or_uniform(beta);
  const Rgb collides = opacity(t_max);
  const int channel = sample_channel(normalized_or_uniform(p_channel * collides), u.y);
  const float t = std::min(sample_distance(channel, u.x * collides[channel]), t_max);
  return scattered_at(t, p_channel);
}

FreeFlight HomogeneousMedium::scattered_at(float t, const Rgb& p_channel) const {
  // The density of t is p_channel . (sigma_t T). Taking out the largest T keeps the ratio finite
  // where both underflow.
  const Rgb tau = sigma_t_ * t;
  const Rgb pdf = sigma_t_ * glm::exp(min_component(tau) - tau);
  return {.scattered = true,
          .t = t,
          .weight = albedo_ * pdf / glm::dot(p_channel, pdf),
          .phase = phase_};
}

Rgb HomogeneousMedium::transmittance(const Ray& /*ray*/, float t_max, Rng& /*rng*/) const {
  return transmittance(t_max);
}

std::optional<Medium::ScatteringAt> HomogeneousMedium::scattering_at(const Ray& /*ray*/, float t,
                                                                     const Rgb& beta) const {
  const Rgb collision = sigma_t_ * transmittance(t);
  return ScatteringAt{.value = albedo_ * collision,
                      .pdf = glm::dot(normalized_or_uniform(beta), collision),
                      .phase = phase_};
}

MediumSummary HomogeneousMedium::summary() const {
  return {.description = fmt::format(
              "homogeneous, sigma_t {:g} {:g} {:g} per unit, albedo {:g} {:g} {:g}, g {:g}",
              sigma_t_.r, sigma_t_.g, sigma_t_.b, albedo_.r, albedo_.g, albedo_.b, phase_.g),
          .scatters = !is_black(albedo_ * sigma_t_),
          .is_tracked = false,
          .is_chromatic = !is_grey(sigma_t_),
          .memory_bytes = 0};
}

}  // namespace brume
