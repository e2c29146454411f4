// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "core/frame.h"
#include "core/rng.h"
#include "light/environment_light.h"
#include "support/chi_square.h"
#include "support/statistics.h"

namespace brume::test {

/// Draws light arriving somewhere.
using LightSampler = std::function<std::optional<LightSample>(Rng&)>;

inline LightSampler sampler_of(const Light& light, const Vec3& p = Vec3(0.0f)) {
  return [&light, p](Rng& rng) { return light.sample(p, rng.next_vec2()); };
}

/// Irradiance per channel of a surface with normal `n`.
inline std::array<RunningMean, 3> irradiance(const LightSampler& sample, const Vec3& n,
                                             int samples) {
  std::array<RunningMean, 3> result;
  Rng rng(7);
  for (int i = 0; i < samples; ++i) {
    const auto s = sample(rng);
    const float cosine = s ? std::max(0.0f, glm::dot(s->d, n)) : 0.0f;
    for (int c = 0; c < 3; ++c) result[c].add(s ? double(s->weight[c]) * double(cosine) : 0.0);
  }
  return result;
}

/// Irradiance of a surface with normal `n` under `radiance`, by the midpoint rule over polar angle
/// and azimuth around +Y with `resolution` x 2 `resolution` points.
inline glm::dvec3 irradiance_by_quadrature(const std::function<Rgb(const Vec3&)>& radiance,
                                           const Vec3& n, int resolution) {
  const double step = M_PI / resolution;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < resolution; ++i) {
    const double theta = (i + 0.5) * step;
    for (int j = 0; j < 2 * resolution; ++j) {
      const double phi = (j + 0.5) * step;
      const Vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                   std::sin(theta) * std::sin(phi));
      sum += std::sin(theta) * double(std::max(0.0f, glm::dot(d, n))) * glm::dvec3(radiance(d));
    }
  }
  return sum * step * step;
}

/// The samples of an environment follow its density, and carry the radiance that is seen.
inline ::testing::AssertionResult is_sampled_as_seen(const EnvironmentLight& light,
                                                     const ChiSquareSettings& settings = {}) {
  Rng rng(3);
  for (int i = 0; i < 10000; ++i) {
    const auto s = light.sample(Vec3(0.0f), rng.next_vec2());
    if (!s) return ::testing::AssertionFailure() << "sample " << i << " found nothing";
    if (s->distance != kInfinity || std::abs(glm::length(s->d) - 1.0f) > 1e-6f)
      return ::testing::AssertionFailure() << "sample " << i << " is not a distant direction";
    const Rgb stated = s->weight * s->pdf, seen = light.radiance(s->d);
    if (!(max_abs(stated - seen) <= settings.pdf_tolerance * max_abs(seen)))
      return ::testing::AssertionFailure()
             << "sample " << i << " carries the radiance " << stated.r << " " << stated.g << " "
             << stated.b << " where " << seen.r << " " << seen.g << " " << seen.b << " is seen";
  }
  return samples_follow_pdf(
      [&](Rng& g) -> std::optional<DirectionSample> {
        const auto s = light.sample(Vec3(0.0f), g.next_vec2());
        if (!s) return std::nullopt;
        return DirectionSample{.d = s->d, .pdf = s->pdf};
      },
      [&](const Vec3& d) { return light.pdf(d); }, settings);
}

}  // namespace brume::test
