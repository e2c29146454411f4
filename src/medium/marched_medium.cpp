// SPDX-License-Identifier: Apache-2.0
#include "medium/marched_medium.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <type_traits>

#include "medium/channel.h"
#include "volume/bounds_grid.h"
#include "volume/packed_grid.h"

namespace brume {
namespace {

template <class Stored>
class MarchedMedium final : public Medium {
 public:
  MarchedMedium(std::shared_ptr<const Grid<Stored>> density, float density_scale,
                std::shared_ptr<const ColorField> albedo, HenyeyGreenstein phase, float step)
      : density_(std::move(density)),
        density_scale_(density_scale),
        albedo_(std::move(albedo)),
        phase_(phase),
        step_(step),
        bounds_(*density_) {
    assert(step > 0.0f);
  }

  FreeFlight sample_free_flight(const Ray& ray, float t_max, const Rgb& beta,
                                Sampler& sampler) const override {
    // One channel proposes the distance, as in a homogeneous medium.
    const Vec2 u = sampler.next_2d();
    const Rgb p_channel = normalized_or_uniform(beta);
    const int channel = sample_channel(p_channel, u.y);
    const float tau_to_collision = -std::log1p(-u.x);

    FreeFlight flight{.t = t_max};
    Rgb tau{0.0f}, sigma_t{1.0f};
    march(ray, t_max, sampler.rng(), [&](float t, float length, const Rgb& sigma) {
      const float missing = tau_to_collision - tau[channel];
      if (!(sigma[channel] * length > missing)) {
        tau += sigma * length;
        return true;
      }
      const float within = missing / sigma[channel];
      tau += sigma * within;
      sigma_t = sigma;
      flight.scattered = true;
      flight.t = t + within;
      return false;
    });
    // Taking out the largest transmittance keeps the ratio finite where all underflow.
    const Rgb T = glm::exp(min_component(tau) - tau);
    flight.weight = flight.scattered ? sigma_t * T / glm::dot(p_channel, sigma_t * T)
                                     : T / glm::dot(p_channel, T);
    if (flight.scattered) {
      flight.weight *= albedo_->value(ray.at(flight.t));
      flight.phase = phase_;
    }
    return flight;
  }

  Rgb transmittance(const Ray& ray, float t_max, Rng& rng) const override {
    Rgb tau{0.0f};
    march(ray, t_max, rng, [&](float /*t*/, float length, const Rgb& sigma_t) {
      tau += sigma_t * length;
      return true;
    });
    return glm::exp(-tau);
  }

  MediumSummary summary() const override {
    return {.description = fmt::format("grid marched in steps of {:g} voxels, extinction {:g} to "
                                       "{:g} per unit, g {:g}",
                                       step_, bounds_.total().min * density_scale_,
                                       bounds_.total().max * density_scale_, phase_.g),
            .scatters = bounds_.total().max > 0.0f,
            .is_tracked = true,
            .is_chromatic = std::is_same_v<Stored, Rgb>,
            .memory_bytes = density_->memory_bytes()};
  }

 private:
  /// Calls `visit(t, length, sigma_t)` for each step along the ray, `length` [unit] long from `t`,
  /// until it returns false.
  template <class Visit>
  void march(const Ray& ray, float t_max, Rng& rng, Visit&& visit) const {
    const auto segment = clip_to_grid(ray, t_max, bounds_, density_->index_from_world());
    if (!segment) return;
    GridLookup<Stored> lookup(*density_);
    const float length = step_ / glm::length(segment->d);
    const float place = rng.next_float();
    // Steps are counted, so that their ends do not drift.
    for (int i = 0;; ++i) {
      const float t0 = float(i) * length;
      if (!(t0 < segment->t_end)) return;
      const float t1 = std::min(float(i + 1) * length, segment->t_end);
      const Vec3 p = segment->o + (t0 + place * (t1 - t0)) * segment->d;
      const auto density = density_->interpolation() == Interpolation::kNearest
                               ? lookup.nearest(p)
                               : lookup.trilinear(p);
      if (!visit(segment->t_start + t0, t1 - t0, density_scale_ * Rgb(density))) return;
    }
  }

  std::shared_ptr<const Grid<Stored>> density_;
  float density_scale_;  // [1/unit] per density
  std::shared_ptr<const ColorField> albedo_;
  HenyeyGreenstein phase_;
  float step_;  // [voxels]
  BoundsGrid bounds_;
};

}  // namespace

template <class Stored>
std::shared_ptr<const Medium> make_marched_medium(std::shared_ptr<const Grid<Stored>> density,
                                                  float density_scale,
                                                  std::shared_ptr<const ColorField> albedo,
                                                  HenyeyGreenstein phase, float step) {
  return std::make_shared<MarchedMedium<Stored>>(std::move(density), density_scale,
                                                 std::move(albedo), phase, step);
}

template <class Stored>
using Make = std::shared_ptr<const Medium>(std::shared_ptr<const Grid<Stored>>, float,
                                           std::shared_ptr<const ColorField>, HenyeyGreenstein,
                                           float);
template Make<float> make_marched_medium<float>;
template Make<Rgb> make_marched_medium<Rgb>;
template Make<Packed16> make_marched_medium<Packed16>;
template Make<Packed8> make_marched_medium<Packed8>;

}  // namespace brume
