// SPDX-License-Identifier: Apache-2.0
#include "app/camera_samples.h"

namespace brume {

SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, bool independent) {
  return [&integrator, &film, seed, independent](std::uint32_t x, std::uint32_t y,
                                                 std::uint32_t index) {
    const Vec2 corner = Vec2(film.crop_offset) + Vec2(float(x), float(y));
    const std::uint32_t pixel =
        std::uint32_t(corner.y) * std::uint32_t(film.size.x) + std::uint32_t(corner.x);
    Sampler sampler(seed, pixel, index, independent);
    const Vec2 offset = film.filter->sample(sampler.next_2d());
    return integrator.sample((corner + 0.5f + offset) / Vec2(film.size), sampler);
  };
}

}  // namespace brume
