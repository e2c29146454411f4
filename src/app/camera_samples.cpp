// SPDX-License-Identifier: Apache-2.0
#include "app/camera_samples.h"

namespace brume {
namespace {

double pixels_per_group(const FilmSettings& film, int spacing) {
  return double(film.size.x) * film.size.y / (double(spacing) * spacing);
}

/// How far apart pixels are that share light paths: farther where there are so many that light
/// paths cost little, as errors that neighbours share are seen. [pixel]
std::uint32_t spacing(const FilmSettings& film) {
  constexpr int kWide = 2 * kLightPathSpacing;
  constexpr double kEnoughPixels = 200.0;
  static_assert(kWide * kWide <= LightPaths::kGroups);
  return pixels_per_group(film, kWide) >= kEnoughPixels ? kWide : kLightPathSpacing;
}

}  // namespace

PathSettings suited_to(const FilmSettings& film, PathSettings path) {
  constexpr double kLeastPixels = 16.0;
  if (pixels_per_group(film, kLightPathSpacing) < kLeastPixels) path.lighting.light_paths = false;
  return path;
}

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
