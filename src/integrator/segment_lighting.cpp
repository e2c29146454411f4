// SPDX-License-Identifier: Apache-2.0
#include "integrator/segment_lighting.h"

#include <cmath>

#include "light/importance.h"

namespace brume {
namespace {

/// Where a light stands beside the segment.
struct Foot {
  double t;       // of the pivot's foot on the ray [unit]
  double height;  // of the pivot above the ray, at least about the light's size [unit]

  Foot(const Light::Pivot& pivot, const Segment& segment) {
    const glm::dvec3 to_pivot = glm::dvec3(pivot.center) - glm::dvec3(segment.ray.o);
    const glm::dvec3 d(segment.ray.d);
    t = glm::dot(to_pivot, d);
    // Closer than its size a light no longer grows as the inverse square.
    height = std::max(
        {glm::length(to_pivot - t * d), 0.5 * double(pivot.radius), 1e-6 * glm::length(to_pivot)});
  }
};

/// Points of the segment, dense where it is near to a light: uniform in the angle at the pivot, in
/// the plane of pivot and ray, as far as light leaves the pivot toward them. Angles are counted
/// from the segment's begin.
struct EquiangularPoints {
  Foot foot;
  double begin = 0.0, end;  // [rad]
  bool is_lit = true;       // or no light leaves the pivot toward the segment
  bool is_clipped = false;  // to what is lit

  EquiangularPoints(const Light::Pivot& pivot, const Segment& segment) : foot(pivot, segment) {
    const double h = foot.height;
    // Positive however short the segment is.
    end = std::isfinite(segment.t_end)
              ? std::atan2(h * segment.t_end, h * h + foot.t * (foot.t - segment.t_end))
              : 0.5 * M_PI + std::atan2(foot.t, h);
    if (pivot.cos_cutoff > 0.0f) clip(pivot, segment);
  }

  /// foot.t + height tan(angle of the origin + angle) as one fraction, in which nothing cancels.
  double t(double angle) const {
    const double tangent = std::tan(angle);
    return tangent * (foot.height * foot.height + foot.t * foot.t) /
           (foot.height + foot.t * tangent);
  }
  double pdf(double at_t) const {
    const double along = at_t - foot.t;
    return foot.height / ((end - begin) * (foot.height * foot.height + along * along));
  }
  /// Whether a point of the segment is one of them.
  bool contain(double at_t) const {
    if (!is_clipped) return true;
    const double angle = std::atan2(at_t - foot.t, foot.height) + std::atan2(foot.t, foot.height);
    return begin <= angle && angle <= end;
  }
  /// Of the point where the light is about the strongest.
  double brightest_angle() const {
    const double margin = 0.25 * (end - begin);
    return std::clamp(std::atan2(foot.t, foot.height), begin + margin, end - margin);
  }

 private:
  /// Leaves the angles that lie in the light's cone, if any do. A direction of the plane makes an
  /// angle with the axis whose cosine is `central` times that of the angle to the most central
  /// direction.
  void clip(const Light::Pivot& pivot, const Segment& segment) {
    const glm::dvec3 d(segment.ray.d), axis(pivot.axis);
    const glm::dvec3 to_foot = glm::dvec3(segment.ray.o) + foot.t * d - glm::dvec3(pivot.center);
    const double across = glm::length(to_foot);
    const double x = across > 0.0 ? glm::dot(axis, to_foot) / across : 0.0, y = glm::dot(axis, d);
    const double central = std::hypot(x, y);
    const double cosine = double(pivot.cos_cutoff) / central;
    const double half = cosine < 1.0 ? std::acos(cosine) : 0.0;
    const double middle = std::atan2(y, x) + std::atan2(foot.t, foot.height);
    const double first = std::max(begin, middle - half), last = std::min(end, middle + half);
    is_lit = is_clipped = first < last;
    if (!is_lit) return;
    begin = first;
    end = last;
  }
};

}  // namespace

struct SegmentLighting::Weights {
  const SegmentLighting& of;

  float operator()(std::size_t light) const {
    if (light >= of.kept_.size()) return weight(light);
    float& kept = of.kept_[light];
    if (kept < 0.0f) kept = weight(light);
    return kept;
  }
  std::optional<float> operator()(const Light::Pivot& cluster) const {
    const float t = nearest(Foot(cluster, of.segment_));
    const auto importance = importance_as_one(cluster, of.segment_.ray.at(t), 1.0f);
    if (!importance) return std::nullopt;
    return *importance * share_left(t);
  }

 private:
  float weight(std::size_t index) const {
    const Light& light = of.lights_.light(index);
    const Light::Pivot pivot = *light.pivot();
    float t;
    if (pivot.cos_cutoff > 0.0f) {
      const EquiangularPoints points(pivot, of.segment_);
      if (!points.is_lit || !(points.foot.height > 0.0)) return 0.0f;
      t = std::clamp(float(points.t(points.brightest_angle())), 0.0f, of.segment_.t_end);
    } else {
      const Foot foot(pivot, of.segment_);
      if (!(foot.height > 0.0)) return 0.0f;
      t = nearest(foot);
    }
    return light.importance(of.segment_.ray.at(t)) * share_left(t);
  }
  float nearest(const Foot& foot) const {
    return float(std::clamp(foot.t, 0.0, double(of.segment_.t_end)));
  }
  /// Of what would scatter at the segment's begin, what still does at `t`.
  float share_left(float t) const {
    const Segment& segment = of.segment_;
    const auto there = segment.medium->scattering_at(segment.ray, t, segment.beta);
    const float share = max_component(segment.beta * there->value) / of.scattering_here_;
    return std::isfinite(share) ? share : 0.0f;
  }
};

SegmentLighting::Weights SegmentLighting::weights() const {
  return {*this};
}

SegmentLighting::SegmentLighting(const LightSet& lights, const Segment& segment)
    : lights_(lights), segment_(segment) {
  if (!segment.seeks_lights || lights.lights_with_pivot().size() == 0) return;
  const auto here = segment.medium->scattering_at(segment.ray, 0.0f, segment.beta);
  if (!here || is_black(here->value) || here->phase.is_delta()) return;
  kept_.fill(-1.0f);
  scattering_here_ = max_component(segment.beta * here->value);
  const float total = lights.lights_with_pivot().total_weight(weights());
  if (!(total > kLeastImportance)) return;
  odds_ = {.per_weight = 1.0f / total};
  // Half of the attention at most, and none to what the lights without a place do better.
  p_near_ = 0.5f * total / (total + lights.importance_without_pivot());
}

SegmentLighting::Point SegmentLighting::sample(float u_choice, float u) const {
  const auto [chosen, p_chosen] = lights_.lights_with_pivot().sample(weights(), odds_, u_choice);
  const EquiangularPoints points(*lights_.light(chosen).pivot(), segment_);
  const double angle = points.begin + u * (points.end - points.begin);
  const float t = std::clamp(float(points.t(angle)), 0.0f, segment_.t_end);
  return {.light = chosen, .t = t, .pdf = p_chosen * float(points.pdf(t))};
}

float SegmentLighting::pdf(std::size_t light, float t) const {
  const float p = lights_.lights_with_pivot().probability(weights(), odds_, light);
  if (!(p > 0.0f)) return 0.0f;
  const EquiangularPoints points(*lights_.light(light).pivot(), segment_);
  return points.contain(t) ? p * float(points.pdf(t)) : 0.0f;
}

float SegmentLighting::choice(std::size_t light, float t, float p_choice) const {
  if (!(p_near_ > 0.0f)) return p_choice;
  const float at_end = (1.0f - p_near_) * p_choice;
  if (!lights_.lights_with_pivot().contains(light)) return at_end;
  const auto scattering = segment_.medium->scattering_at(segment_.ray, t, segment_.beta);
  return at_end + p_near_ * pdf(light, t) * segment_.p_scatter / scattering->pdf;
}

}  // namespace brume
