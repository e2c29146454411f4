// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "light/environment_light.h"
#include "light/light.h"

namespace brume {

/// All lights of a scene, and the choice among them.
///
/// Environments overlap: the sun's disk stands before the sky. They are treated as one technique
/// that draws from the mixture of their densities and sees the sum of their radiances, so a
/// direction has one radiance and one density, whichever of them proposed it.
class LightSet {
 public:
  /// Lights are numbered in this order, environments after the others.
  LightSet(std::vector<std::shared_ptr<const Light>> lights,
           std::vector<std::shared_ptr<const EnvironmentLight>> environments);

  std::size_t size() const { return lights_.size() + environments_.size(); }

  /// Light arriving at `p` from a light chosen by `u_choice`. The probability of the choice is
  /// part of `weight` and `pdf`. Nothing when no light arrives that way.
  std::optional<LightSample> sample(const Vec3& p, float u_choice, const Vec2& u) const;
  /// Probability that `sample` at `p` chooses light `index`; with the light's own density, the
  /// density of `sample` for a light that a ray found by itself.
  float probability(const Vec3& p, std::size_t index) const;

  /// Seen along `d` by a ray that leaves the scene [W/(m^2 sr)].
  Rgb environment_radiance(const Vec3& d) const;
  /// Density of `sample` at `from` for the environment along `d` [1/sr].
  float environment_pdf(const Vec3& from, const Vec3& d) const;

 private:
  std::vector<std::shared_ptr<const Light>> lights_;
  std::vector<std::shared_ptr<const EnvironmentLight>> environments_;
};

}  // namespace brume
