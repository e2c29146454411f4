// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "core/box.h"
#include "core/distribution.h"
#include "integrator/camera_medium.h"
#include "integrator/light_tracer.h"

namespace brume {

/// A place where a path from the camera scatters first, as light would find it.
struct Receiver {
  Vec3 p;                    // [unit]
  Vec3 d;                    // unit, along which the camera's ray arrives
  const Medium* medium;      // through which it does
  std::optional<Hit> hit{};  // if on a surface
  float weight;              // of the camera's path, in luminance
};

/// `count` of them at most.
std::vector<Receiver> find_receivers(const Scene& scene, const Camera& camera,
                                     const CameraMedium& camera_medium, int count);

/// Knows from a trial which light paths reach what the camera sees: in which directions they leave
/// the lamps, and where the places lie from which they are seen. It steers where light paths are
/// looked for, not what is expected of them.
class LightPathGuide {
 public:
  /// The arguments must outlive the guide, the receivers only the constructor. Precondition: the
  /// tracer has lamps.
  LightPathGuide(const Scene& scene, const LightTracer& tracer,
                 std::span<const Receiver> receivers);

  /// Whether light was found that goes on to what the camera sees.
  bool found_light() const { return !keep_.empty(); }

  /// How a light path begins.
  struct Start {
    std::size_t lamp;
    Vec2 u_direction;
    float weight;  // one over the density of this choice
  };
  Start start(Sampler& sampler) const;

  /// Probability with which a place is worth being kept, in (0, 1].
  float keep(const LightVertex& vertex) const;
  /// Places that a light path leaves on average when they are kept so.
  float kept_per_path() const { return kept_per_path_; }

  /// Of everything where light scatters.
  const Box3& bounds() const { return bounds_; }
  /// Collisions on the way through the scene's media, roughly and on average [1/unit].
  float sigma_t() const { return sigma_t_; }
  /// Distances between places where light scatters one after the other [unit].
  std::span<const float> distances() const { return distances_; }

 private:
  struct Trial;
  Trial run_trial(int paths, std::uint64_t seed, std::span<const Receiver> receivers) const;
  void learn_directions(const Trial& trial);
  void learn_places(const Trial& trial);
  std::size_t cell(const LightVertex& vertex) const;

  const Scene& scene_;
  const LightTracer& tracer_;
  Distribution1d lamps_;
  std::vector<Distribution2d> directions_;  // [lamp], of u_direction; empty: uniform
  Box3 bounds_{};
  std::vector<float> keep_;  // [cell]
  float kept_per_path_ = 0.0f;
  float sigma_t_ = 0.0f;
  std::vector<float> distances_;
};

}  // namespace brume
