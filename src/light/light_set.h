// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "core/ray.h"
#include "light/environment_light.h"
#include "light/light.h"
#include "light/light_tree.h"

namespace brume {

/// All lights of a scene, and the choice among them.
///
/// Lights are chosen mostly by `Light::importance`, many of them cluster by cluster, and with some
/// probability uniformly, because what stands in between is not known. An environment whose
/// importance is 0 is left to the paths that leave the scene.
///
/// Environments overlap: the sun's disk stands before the sky. They are treated as one technique
/// that draws from the mixture of their densities and sees the sum of their radiances, so a
/// direction has one radiance and one density, whichever of them proposed it.
class LightSet {
 public:
  /// Lights are numbered in this order, environments after the others.
  LightSet(std::vector<std::shared_ptr<const Light>> lights,
           std::vector<std::shared_ptr<const EnvironmentLight>> environments);

  bool has_environment() const { return !environments_.empty(); }
  std::size_t size() const { return lights_.size() + environments_.size(); }

  /// Light arriving somewhere from a light that was chosen.
  struct Arrival {
    LightSample light;  // the probability of the choice is part of `weight` and `pdf`
    std::size_t index;  // of the light; of any environment for the environments
    float p_choice;     // probability of the choice; 1 for environments, which are one technique
  };
  /// Light arriving at `p` from a light chosen by `u_choice`. Nothing when no light arrives that
  /// way.
  std::optional<Arrival> sample(const Vec3& p, float u_choice, const Vec2& u) const;
  /// Probability that `sample` at `p` chooses light `index`; with the light's own density, the
  /// density of `sample` for a light that a ray found by itself.
  float probability(const Vec3& p, std::size_t index) const;

  /// Seen along `d` by a ray that leaves the scene from `from`: all environments together, with the
  /// density of `sample` at `from` for them.
  EnvironmentLight::View environment_view(const Vec3& from, const Vec3& d) const;
  /// Its radiance alone [W/(m^2 sr)].
  Rgb environment_radiance(const Vec3& d) const;

  /// Light number `index`, which is not an environment.
  const Light& light(std::size_t index) const { return *lights_[index]; }
  /// The lights that have a pivot.
  const LightTree& lights_with_pivot() const { return with_pivot_; }
  /// Sum of the importance of the others, which is the same everywhere.
  float importance_without_pivot() const { return importance_without_pivot_; }

 private:
  /// What the lights with a pivot are worth at `p`.
  struct ImportanceAt;
  LightTree::Odds odds_at(const Vec3& p) const;
  bool may_choose(std::size_t index) const;
  /// Of a light without a pivot.
  float probability(const LightTree::Odds& odds, std::size_t index) const {
    return may_choose(index) ? odds.each + odds.per_weight * far_importance_[index] : 0.0f;
  }

  std::vector<std::shared_ptr<const Light>> lights_;
  std::vector<std::shared_ptr<const EnvironmentLight>> environments_;
  LightTree with_pivot_;
  std::vector<std::size_t> far_choices_;  // the others that `sample` may choose
  std::vector<float> far_importance_;     // [light] of those without a pivot, 0 for the others
  float importance_without_pivot_ = 0.0f;
};

}  // namespace brume
