// SPDX-License-Identifier: Apache-2.0
#include "medium/heterogeneous_medium.h"

#include <cassert>
#include <cmath>

#include "medium/majorant_check.h"
#include "volume/bounds_grid.h"

namespace brume {
namespace {

/// Optical thickness that a flight passes before its next tentative collision; `u` in [0, 1).
float sample_optical_thickness(float u) {
  return -std::log1p(-u);
}

// --- What a tentative collision with extinction `sigma_t` under the majorant turns into.
// Returns whether it is real; multiplies `weight` by value over probability either way.

bool decide_collision(float sigma_t, float sigma_maj, const Rgb& /*beta*/, Rgb& /*weight*/,
                      Rng& rng) {
  return rng.next_float() * sigma_maj < sigma_t;
}

/// Probability averaged over the channels with what each still carries (Kutz et al. 2017, eq. 14).
bool decide_collision(const Rgb& sigma_t, float sigma_maj, const Rgb& beta, Rgb& weight, Rng& rng) {
  const Rgb carried = beta * weight;
  const float total = carried.r + carried.g + carried.b;
  const Rgb p_real_channel = glm::min(sigma_t / sigma_maj, Rgb{1.0f});
  const float p_real =
      total > 0.0f ? glm::dot(carried, p_real_channel) / total : mean(p_real_channel);
  const bool real = rng.next_float() < p_real;
  weight *= real ? p_real_channel / p_real : (1.0f - p_real_channel) / (1.0f - p_real);
  return real;
}

float largest(float v) {
  return v;
}
float largest(const Rgb& v) {
  return max_component(v);
}

template <class Value>
class HeterogeneousMedium final : public Medium {
 public:
  HeterogeneousMedium(std::shared_ptr<const Grid<Value>> density, float density_scale,
                      std::shared_ptr<const ColorField> albedo, HenyeyGreenstein phase)
      : density_(std::move(density)),
        density_scale_(density_scale),
        albedo_(std::move(albedo)),
        phase_(phase),
        bounds_(*density_) {
    assert(std::isfinite(bounds_.total().max * density_scale_));
  }

  FreeFlight sample_free_flight(const Ray& ray, float t_max, const Rgb& beta,
                                Sampler& sampler) const override {
    FreeFlight flight{.t = t_max};
    const auto segment = clip_to_grid(ray, t_max, bounds_, density_->index_from_world());
    if (!segment) return flight;

    Rng& rng = sampler.rng();
    GridLookup<Value> lookup(*density_);
    float tau = sample_optical_thickness(sampler.next_1d());
    walk_cells(bounds_, *segment, [&](const glm::ivec3& cell, float t, float t1) {
      const float sigma_maj = bounds_.range(cell).max * density_scale_;
      if (!(sigma_maj > 0.0f)) return true;
      const Box3 cell_box = bounds_.cell_box(cell);
      while (true) {
        const float tau_to_end = sigma_maj * (t1 - t);
        if (!(tau < tau_to_end)) {
          tau -= tau_to_end;
          return true;
        }
        t += tau / sigma_maj;
        tau = sample_optical_thickness(rng.next_float());
        const Value sigma_t = extinction(lookup, cell_box, *segment, t, rng);
        check_majorant(largest(sigma_t), sigma_maj);
        if (decide_collision(sigma_t, sigma_maj, beta, flight.weight, rng)) {
          flight.scattered = true;
          flight.t = segment->t_start + t;
          return false;
        }
      }
    });

    if (flight.scattered) {
      flight.weight *= albedo_->value(ray.at(flight.t));
      flight.phase = phase_;
    }
    return flight;
  }

  Rgb transmittance(const Ray& ray, float t_max, Rng& rng) const override {
    Value T(1.0f);
    const auto segment = clip_to_grid(ray, t_max, bounds_, density_->index_from_world());
    if (!segment) return Rgb(T);

    GridLookup<Value> lookup(*density_);
    float tau = sample_optical_thickness(rng.next_float());
    walk_cells(bounds_, *segment, [&](const glm::ivec3& cell, float t, float t1) {
      const float sigma_maj = bounds_.range(cell).max * density_scale_;
      if (!(sigma_maj > 0.0f)) return true;
      const Box3 cell_box = bounds_.cell_box(cell);
      while (true) {
        const float tau_to_end = sigma_maj * (t1 - t);
        if (!(tau < tau_to_end)) {
          tau -= tau_to_end;
          return true;
        }
        t += tau / sigma_maj;
        tau = sample_optical_thickness(rng.next_float());
        const Value sigma_t = extinction(lookup, cell_box, *segment, t, rng);
        check_majorant(largest(sigma_t), sigma_maj);
        T *= glm::max(1.0f - sigma_t / sigma_maj, Value(0.0f));
        if (!survives_roulette(T, rng)) return false;
      }
    });
    return Rgb(T);
  }

 private:
  /// Extinction at t along the segment [1/unit], with the expectation of interpolation. The point
  /// is held inside its cell, whose bounds therefore hold, whatever the rounding of t.
  Value extinction(GridLookup<Value>& lookup, const Box3& cell_box, const IndexSegment& segment,
                   float t, Rng& rng) const {
    const Vec3 p = glm::clamp(segment.o + t * segment.d, cell_box.min, cell_box.max);
    return density_scale_ * (density_->interpolation() == Interpolation::kNearest
                                 ? lookup.nearest(p)
                                 : lookup.stochastic(p, rng));
  }

  /// Unbiased end of an estimate that has become small; sets T to 0 when it ends.
  static bool survives_roulette(Value& T, Rng& rng) {
    constexpr float kThreshold = 0.1f;
    const float remaining = largest(T);
    if (remaining >= kThreshold) return true;
    if (rng.next_float() * kThreshold < remaining) {
      T *= kThreshold / remaining;
      return true;
    }
    T = Value(0.0f);
    return false;
  }

  std::shared_ptr<const Grid<Value>> density_;
  float density_scale_;  // [1/unit] per density
  std::shared_ptr<const ColorField> albedo_;
  HenyeyGreenstein phase_;
  BoundsGrid bounds_;
};

}  // namespace

std::shared_ptr<const Medium> make_heterogeneous_medium(std::shared_ptr<const Grid<float>> density,
                                                        float density_scale,
                                                        std::shared_ptr<const ColorField> albedo,
                                                        HenyeyGreenstein phase) {
  return std::make_shared<HeterogeneousMedium<float>>(std::move(density), density_scale,
                                                      std::move(albedo), phase);
}

std::shared_ptr<const Medium> make_heterogeneous_medium(std::shared_ptr<const Grid<Rgb>> density,
                                                        float density_scale,
                                                        std::shared_ptr<const ColorField> albedo,
                                                        HenyeyGreenstein phase) {
  return std::make_shared<HeterogeneousMedium<Rgb>>(std::move(density), density_scale,
                                                    std::move(albedo), phase);
}

}  // namespace brume
