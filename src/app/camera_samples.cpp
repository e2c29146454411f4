// SPDX-License-Identifier: Apache-2.0
#include "app/camera_samples.h"

#include "render/sample_plan.h"

namespace brume {
namespace {

/// Pixels with the same coordinates modulo this share light paths: farther apart where there are so
/// many that light paths cost little, as errors that neighbours share are seen.
std::uint32_t spacing(const FilmSettings& film) {
  constexpr std::uint32_t kWindow = SamplePlan::kWindow;
  constexpr double kPixelsPerGroup = 200.0;
  static_assert(2 * kWindow * 2 * kWindow <= LightPaths::kGroups);
  const double pixels = double(film.size.x) * film.size.y;
  return pixels >= 4 * kWindow * kWindow * kPixelsPerGroup ? 2 * kWindow : kWindow;
}

}  // namespace

SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, bool independent) {
  return [&integrator, &film, seed, independent, spacing = spacing(film)](
             std::uint32_t x, std::uint32_t y, std::uint32_t index) {
    const Vec2 corner = Vec2(film.crop_offset) + Vec2(float(x), float(y));
    const auto column = std::uint32_t(corner.x), row = std::uint32_t(corner.y);
    const std::uint32_t pixel = row * std::uint32_t(film.size.x) + column;
    Sampler sampler(seed, pixel, index, independent);
    const Vec2 offset = film.filter->sample(sampler.next_2d());
    const std::uint32_t group = row % spacing * spacing + column % spacing;
    return integrator.sample((corner + 0.5f + offset) / Vec2(film.size), sampler, group);
  };
}

}  // namespace brume
