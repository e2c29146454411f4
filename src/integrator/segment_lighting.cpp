// SPDX-License-Identifier: Apache-2.0
#include "integrator/segment_lighting.h"

#include <cmath>

namespace brume {
namespace {

/// The segment as a light sees it: angles around the pivot, in the plane of pivot and ray.
struct Angles {
  double t_closest;         // of the pivot's foot on the ray [unit]
  double height;            // of the pivot above the ray, at least about the light's size [unit]
  double theta_0, theta_1;  // of the ends of the segment [rad]

  Angles(const Light::Pivot& pivot, const Segment& segment) {
    const glm::dvec3 to_pivot = glm::dvec3(pivot.center) - glm::dvec3(segment.ray.o);
    const glm::dvec3 d(segment.ray.d);
    t_closest = glm::dot(to_pivot, d);
    // Closer than its size a light no longer grows as the inverse square.
    height = std::max({glm::length(to_pivot - t_closest * d), 0.5 * double(pivot.radius),
                       1e-6 * glm::length(to_pivot)});
    theta_0 = std::atan2(-t_closest, height);
    theta_1 =
        std::isfinite(segment.t_end) ? std::atan2(segment.t_end - t_closest, height) : 0.5 * M_PI;
  }

  bool degenerate() const { return !(height > 0.0) || !(theta_1 > theta_0); }

  double t(double u) const {
    return t_closest + height * std::tan(theta_0 + u * (theta_1 - theta_0));
  }
  double pdf(double at_t) const {
    const double along = at_t - t_closest;
    return height / ((theta_1 - theta_0) * (height * height + along * along));
  }
};

}  // namespace

SegmentLighting::SegmentLighting(const LightSet& lights, const Segment& segment)
    : lights_(lights), segment_(segment) {
  if (!segment.seeks_lights || lights.lights_with_pivot().empty()) return;
  for (const std::size_t light : lights.lights_with_pivot()) total_weight_ += weight(light);
  if (!(total_weight_ > 0.0f)) return;
  // Half of the attention at most, and none to what the lights without a place do better.
  const float others = lights.importance_without_pivot();
  p_near_ = 0.5f * total_weight_ / (total_weight_ + others);
}

float SegmentLighting::weight(std::size_t light) const {
  const Angles angles(*lights_.light(light).pivot(), segment_);
  if (angles.degenerate()) return 0.0f;
  const float t = float(std::clamp(angles.t_closest, 0.0, double(segment_.t_end)));
  const auto here = segment_.medium->scattering_at(segment_.ray, 0.0f, segment_.beta);
  const auto there = segment_.medium->scattering_at(segment_.ray, t, segment_.beta);
  if (!here || is_black(here->value) || here->phase.is_delta()) return 0.0f;
  const float T =
      max_component(segment_.beta * there->value) / max_component(segment_.beta * here->value);
  return lights_.light(light).importance(segment_.ray.at(t)) * (std::isfinite(T) ? T : 0.0f);
}

SegmentLighting::Point SegmentLighting::sample(float u_choice, float u) const {
  std::size_t chosen = 0;
  float p_chosen = 0.0f;
  float remaining = u_choice;
  for (const std::size_t light : lights_.lights_with_pivot()) {
    const float p = weight(light) / total_weight_;
    if (p > 0.0f) {
      chosen = light;
      p_chosen = p;
    }
    remaining -= p;
    if (remaining < 0.0f) break;
  }
  const Angles angles(*lights_.light(chosen).pivot(), segment_);
  const float t = std::clamp(float(angles.t(u)), 0.0f, segment_.t_end);
  return {.light = chosen, .t = t, .pdf = p_chosen * float(angles.pdf(t))};
}

float SegmentLighting::pdf(std::size_t light, float t) const {
  const float p = weight(light) / total_weight_;
  return p > 0.0f ? p * float(Angles(*lights_.light(light).pivot(), segment_).pdf(t)) : 0.0f;
}

float SegmentLighting::choice(std::size_t light, float t, float p_choice) const {
  if (!(p_near_ > 0.0f)) return p_choice;
  const float at_end = (1.0f - p_near_) * p_choice;
  if (!lights_.has_pivot(light)) return at_end;
  const auto scattering = segment_.medium->scattering_at(segment_.ray, t, segment_.beta);
  return at_end + p_near_ * pdf(light, t) / scattering->pdf;
}

}  // namespace brume
