// SPDX-License-Identifier: Apache-2.0
#include "app/camera_samples.h"

#include "core/hash.h"

namespace brume {
namespace {

constexpr std::uint32_t kSeveral = 2;  // sets of light paths along each axis, where not one

/// Of a set of light paths for pixels a multiple of kLightPathSpacing apart, where there are as
/// many sets for such pixels along each axis.
double pixels_per_set(const FilmSettings& film, std::uint32_t sets_across) {
  const double spacing = double(kLightPathSpacing) * sets_across;
  return double(film.size.x) * film.size.y / (spacing * spacing);
}

/// Sets of light paths along each axis for pixels a multiple of kLightPathSpacing apart. Several
/// where they cost little, as errors that neighbours share are seen, and where pixels go on at
/// paces of their own, so that one that takes several blocks in a turn meets others in each.
std::uint32_t sets_across(const FilmSettings& film, bool adaptive) {
  constexpr double kEnoughPixels = 200.0;
  static_assert(kSeveral * kSeveral * kLightPathSpacing * kLightPathSpacing <= LightPaths::kGroups);
  return adaptive || pixels_per_set(film, kSeveral) >= kEnoughPixels ? kSeveral : 1;
}

}  // namespace

PathSettings suited_to(const FilmSettings& film, PathSettings path) {
  constexpr double kLeastPixels = 16.0;
  if (pixels_per_set(film, 1) < kLeastPixels) path.lighting.light_paths = false;
  return path;
}

bool suits_adaptive_sampling(const FilmSettings& film) {
  constexpr double kLeastPixels = 100.0;
  return pixels_per_set(film, kSeveral) >= kLeastPixels;
}

std::uint32_t light_path_group(std::uint32_t column, std::uint32_t row, std::uint32_t block,
                               std::uint32_t sets_across) {
  const std::uint32_t spacing = sets_across * kLightPathSpacing;
  const std::uint32_t x = (column + block % sets_across * kLightPathSpacing) % spacing;
  const std::uint32_t y = (row + block / sets_across % sets_across * kLightPathSpacing) % spacing;
  return y * spacing + x;
}

SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, const CameraSampling& how) {
  return [&integrator, &film, seed, how, across = sets_across(film, how.adaptive)](
             std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
    const Vec2 corner = Vec2(film.crop_offset) + Vec2(float(x), float(y));
    const auto column = std::uint32_t(corner.x), row = std::uint32_t(corner.y);
    const std::uint32_t pixel = row * std::uint32_t(film.size.x) + column;
    Sampler sampler(seed, pixel, index, how.independent);
    const Vec2 offset = film.filter->sample(sampler.next_2d());

    const std::uint32_t group = light_path_group(column, row, index / Sampler::kBlock, across);
    return integrator.sample((corner + 0.5f + offset) / Vec2(film.size), sampler,
                             {.seed = hash_combine(seed, turn), .group = group});
  };
}

}  // namespace brume
