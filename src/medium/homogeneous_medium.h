// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "medium/medium.h"

namespace brume {

/// Constant coefficients everywhere inside the boundary; everything is in closed form.
class HomogeneousMedium final : public Medium {
 public:
  /// `sigma_t` [1/unit] >= 0 and `albedo` = sigma_s / sigma_t in [0, 1], per channel.
  /// Light scattered straight on (g = 1) goes on as if nothing had happened, so that only what is
  /// absorbed counts.
  HomogeneousMedium(const Rgb& sigma_t, const Rgb& albedo, HenyeyGreenstein phase)
      : sigma_t_(phase.keeps_direction() ? sigma_t * (1.0f - albedo) : sigma_t),
        albedo_(phase.keeps_direction() ? Rgb{0.0f} : albedo),
        phase_(phase) {}

  /// Beer-Lambert law: the fraction of light that crosses `distance` [unit] without a collision.
  Rgb transmittance(float distance) const;

  /// Distance to the next medium event, exponential with the extinction of `channel` [unit];
  /// infinite where that channel has none. `u` in [0, 1).
  float sample_distance(int channel, float u) const;

  /// Probability that `sample_distance`, with its channel drawn from `p_channel`, passes
  /// `distance` [unit]: what a surface there is divided by.
  float probability_of_passing(float distance, const Rgb& p_channel) const;

  FreeFlight sample_free_flight(const Ray& ray, float t_max, const Rgb& beta,
                                Sampler& sampler) const override;
  Rgb transmittance(const Ray& ray, float t_max, Rng& rng) const override;
  std::optional<float> probability_of_scattering(const Ray& ray, float t_max,
                                                 const Rgb& beta) const override;
  FreeFlight sample_scattering(const Ray& ray, float t_max, const Rgb& beta,
                               Sampler& sampler) const override;
  std::optional<ScatteringAt> scattering_at(const Ray& ray, float t,
                                            const Rgb& beta) const override;
  MediumSummary summary() const override;

 private:
  /// Probability of a collision within `distance` [unit], exact where it is small.
  Rgb opacity(float distance) const;
  /// A flight that scatters at `t`, as `p_channel` proposes it.
  FreeFlight scattered_at(float t, const Rgb& p_channel) const;

  Rgb sigma_t_;  // [1/unit]
  Rgb albedo_;
  HenyeyGreenstein phase_;
};

}  // namespace brume
