// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/common.hpp>

#include "media.h"
#include "noise.h"

namespace brume::media {
namespace {

constexpr glm::ivec3 kSize(160, 36, 160);  // [voxels], y up

double density_at(const Vec3& p) {
  // Drifts: long billows, stretched along the wind (x) and folded by slow turbulence.
  const Vec3 bent = p + 9.0 * perlin_vector(p / 38.0, 3, 0.5, 211);
  const double drift = perlin_octaves(bent / Vec3(46.0, 16.0, 30.0), 5, 0.55, 223);

  // The top rolls; below it the fog thickens towards the ground.
  const double top = 14.0 + 16.0 * perlin_octaves(Vec3(bent.x, 0.0, bent.z) / 44.0, 4, 0.5, 241);
  const double h = p.y / std::max(top, 3.0);
  const double falloff = std::exp(-1.6 * h * h);
  const double wisps = glm::mix(1.0, smooth_step(-0.3, 0.5, drift), 0.6 + 0.4 * std::min(h, 1.0));

  // It thins out towards the sides, so that no box shows.
  const auto side = [](double x, int n) {
    return smooth_step(0.0, 26.0, std::min(x, double(n - 1) - x));
  };
  const double sides = side(p.x + 14.0 * drift, kSize.x) * side(p.z + 14.0 * drift, kSize.z);
  const double ceiling = 1.0 - smooth_step(0.6, 1.0, p.y / double(kSize.y - 1));
  return falloff * wisps * sides * ceiling;
}

}  // namespace

DenseGrid<float> make_fog_bank() {
  DenseGrid<float> density(kSize);
  density.for_each([&](int x, int y, int z) { density(x, y, z) = float(density_at({x, y, z})); });
  return density;
}

}  // namespace brume::media
