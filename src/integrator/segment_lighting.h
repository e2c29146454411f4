// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "light/light_set.h"
#include "medium/medium.h"

namespace brume {

/// A flight through a medium that began with throughput `beta`, up to `t_end` [unit].
struct Segment {
  Ray ray;
  float t_end;
  Rgb beta;
  const Medium* medium;
  bool seeks_lights;       // whether points near lights are worth their cost
  float p_scatter = 1.0f;  // of flights along it, where it stands for those that scatter; else 1
};

/// Where along a segment to look for light: near the lights, where flights seldom happen to end.
/// Points are drawn with a density that cancels the inverse square of the distance to a light
/// (equiangular sampling, Kulla and Fajardo 2012).
///
/// Next-event estimation along a segment takes either such a point, with probability `p_near`, or
/// the point where the flight scattered; both count with the density of the mixture (one-sample
/// balance heuristic, Veach 1997).
class SegmentLighting {
 public:
  SegmentLighting(const LightSet& lights, const Segment& segment);

  /// 0 where no light is near, or the medium has no closed form.
  float p_near() const { return p_near_; }

  struct Point {
    std::size_t light;
    float t;    // in [0, t_end) [unit]
    float pdf;  // of `t` times the probability of the light [1/unit]
  };
  /// Precondition: p_near() > 0.
  Point sample(float u_choice, float u) const;
  /// Density of `sample` [1/unit].
  float pdf(std::size_t light, float t) const;

  /// Density with which next-event estimation takes `light` and the point `t` where a flight may
  /// scatter, over the density of such a flight; `p_choice` is the probability with which the light
  /// is chosen from that point.
  float choice(std::size_t light, float t, float p_choice) const;

 private:
  /// What lights are worth where the segment passes them.
  struct Weights;
  Weights weights() const;

  const LightSet& lights_;
  const Segment& segment_;
  float p_near_ = 0.0f;
  LightTree::Odds odds_{};
  float scattering_here_ = 0.0f;  // at the segment's begin, of its throughput [1/unit]
  /// [light]; the first lights' weights are asked for again, negative before.
  mutable std::array<float, 16> kept_;
};

}  // namespace brume
