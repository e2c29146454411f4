// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>
#include <string>

#include "core/ray.h"
#include "core/rgb.h"
#include "core/rng.h"
#include "core/sampler.h"
#include "phase/henyey_greenstein.h"

namespace brume {

/// What a segment of a path meets first: scattering inside the medium, or its end.
struct FreeFlight {
  bool scattered = false;
  float t = 0.0f;            // where, in [0, t_max) if scattered, else t_max [unit]
  Rgb weight{1.0f};          // transmittance and albedo over the probability of this outcome
  HenyeyGreenstein phase{};  // at the scattering event
};

/// What a medium asks of the renderer, for people.
struct MediumSummary {
  std::string description;
  bool scatters;             // or only absorbs
  bool is_tracked;           // by null collisions, or else in closed form
  bool is_chromatic;         // the channels travel different distances
  std::size_t memory_bytes;  // of volume data and bounds
};

/// A participating medium. It fills whatever its boundary encloses; where its own volume data
/// ends, it is vacuum.
class Medium {
 public:
  virtual ~Medium() = default;

  /// How far light travels before it scatters, up to `t_max` (which may be infinite). `beta` is
  /// the throughput so far and guides the choice of colour channel, not the expectation.
  virtual FreeFlight sample_free_flight(const Ray& ray, float t_max, const Rgb& beta,
                                        Sampler& sampler) const = 0;

  /// Unbiased estimate of exp(-int_0^t_max sigma_t dt); exact where a closed form exists.
  virtual Rgb transmittance(const Ray& ray, float t_max, Rng& rng) const = 0;

  /// Probability with which `sample_free_flight` scatters, where it is known in closed form.
  /// Transmittance is then exact, and `scattering_at` is known too.
  virtual std::optional<float> probability_of_scattering(const Ray& /*ray*/, float /*t_max*/,
                                                         const Rgb& /*beta*/) const {
    return std::nullopt;
  }
  /// One of the flights of `sample_free_flight` that scatter, with the same weight. Precondition:
  /// the probability that one does is known and positive.
  virtual FreeFlight sample_scattering(const Ray& /*ray*/, float /*t_max*/, const Rgb& /*beta*/,
                                       Sampler& /*sampler*/) const {
    assert(false);  // no medium that knows the probability leaves this out
    return {};
  }

  /// Scattering at a point of a flight, where it is known in closed form.
  struct ScatteringAt {
    Rgb value;  // transmittance to the point times sigma_s there [1/unit]
    float pdf;  // density with which `sample_free_flight` scatters there [1/unit]
    HenyeyGreenstein phase;
  };
  /// What a flight with throughput `beta` would meet at `t`; nothing where only tracking can tell.
  virtual std::optional<ScatteringAt> scattering_at(const Ray& /*ray*/, float /*t*/,
                                                    const Rgb& /*beta*/) const {
    return std::nullopt;
  }

  /// Asks memory for what a flight along `ray`, from within the medium, is going to read first.
  virtual void prefetch(const Ray& /*ray*/) const {}

  /// The medium that stands for this one where light has scattered so often that only its diffusion
  /// counts; the medium itself where none was built.
  virtual const Medium& similar() const { return *this; }

  virtual MediumSummary summary() const = 0;
};

}  // namespace brume
