// SPDX-License-Identifier: Apache-2.0
#include "app/camera_samples.h"

#include "render/sample_plan.h"

namespace brume {
namespace {

/// Pixels that have a say in one another's number of samples must not share light paths.
std::uint32_t group(std::uint32_t column, std::uint32_t row) {
  static_assert(SamplePlan::kWindow * SamplePlan::kWindow == LightPaths::kGroups);
  return row % SamplePlan::kWindow * SamplePlan::kWindow + column % SamplePlan::kWindow;
}

}  // namespace

SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, bool independent) {
  return [&integrator, &film, seed, independent](std::uint32_t x, std::uint32_t y,
                                                 std::uint32_t index) {
    const Vec2 corner = Vec2(film.crop_offset) + Vec2(float(x), float(y));
    const auto column = std::uint32_t(corner.x), row = std::uint32_t(corner.y);
    const std::uint32_t pixel = row * std::uint32_t(film.size.x) + column;
    Sampler sampler(seed, pixel, index, independent);
    const Vec2 offset = film.filter->sample(sampler.next_2d());
    return integrator.sample((corner + 0.5f + offset) / Vec2(film.size), sampler,
                             group(column, row));
  };
}

}  // namespace brume
