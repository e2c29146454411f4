// SPDX-License-Identifier: Apache-2.0
#include "noise.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace brume::media {

std::uint32_t hash(glm::ivec3 p, std::uint32_t seed) {
  std::uint32_t x = std::uint32_t(p.x) + seed * 0x9e3779b9u, y = std::uint32_t(p.y),
                z = std::uint32_t(p.z);
  x = x * 1664525u + 1013904223u;
  y = y * 1664525u + 1013904223u;
  z = z * 1664525u + 1013904223u;
  for (int round = 0; round < 2; ++round) {
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
  }
  return x;
}

double perlin(const Vec3& p, std::uint32_t seed) {
  const Vec3 floor = glm::floor(p);
  const glm::ivec3 i(floor);
  const Vec3 f = p - floor;
  const Vec3 fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const auto corner = [&](int x, int y, int z) {
    const std::uint32_t h = hash(i + glm::ivec3(x, y, z), seed) >> 28;
    const Vec3 d = f - Vec3(x, y, z);
    const double u = h < 8 ? d.x : d.y;  // one of the edges of a cube
    const double v = h < 4 ? d.y : h == 12 || h == 14 ? d.x : d.z;
    return ((h & 1u) != 0 ? -u : u) + ((h & 2u) != 0 ? -v : v);
  };
  const auto along_x = [&](int y, int z) {
    return glm::mix(corner(0, y, z), corner(1, y, z), fade.x);
  };
  return glm::mix(glm::mix(along_x(0, 0), along_x(1, 0), fade.y),
                  glm::mix(along_x(0, 1), along_x(1, 1), fade.y), fade.z);
}

double perlin_octaves(Vec3 p, int octaves, double gain, std::uint32_t seed) {
  double sum = 0.0, size = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += size * perlin(p, seed + std::uint32_t(octave));
    size *= gain;
    p = p * 2.0 + 17.3;  // moved, so that the zeros of the octaves do not meet
  }
  return sum;
}

double bumps(const Vec3& p, std::uint32_t seed) {
  const Vec3 floor = glm::floor(p);
  double nearest = 1.0;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const glm::ivec3 cell = glm::ivec3(floor) + glm::ivec3(x, y, z);
        const Vec3 jitter(unit(hash(cell, seed)), unit(hash(cell, seed + 1)),
                          unit(hash(cell, seed + 2)));
        const Vec3 d = p - (Vec3(cell) + jitter);
        nearest = std::min(nearest, glm::dot(d, d));
      }
  return 1.0 - std::sqrt(nearest);
}

Vec3 perlin_vector(const Vec3& p, int octaves, double gain, std::uint32_t seed) {
  return {perlin_octaves(p, octaves, gain, seed), perlin_octaves(p, octaves, gain, seed + 101),
          perlin_octaves(p, octaves, gain, seed + 202)};
}

}  // namespace brume::media
