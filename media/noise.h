// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace brume::media {

using Vec3 = glm::dvec3;

/// 32 well-mixed bits of a lattice point (Jarzynski and Olano 2020, pcg3d, first component).
std::uint32_t hash(glm::ivec3 p, std::uint32_t seed);

/// Uniform in [0, 1) from a hash.
inline double unit(std::uint32_t h) {
  return h * 0x1p-32;
}

/// Gradient noise of unit lattice, about [-1, 1] (Perlin 2002).
double perlin(const Vec3& p, std::uint32_t seed);

/// Sum of octaves, each of twice the frequency and `gain` times the size; about [-1, 1].
double perlin_octaves(Vec3 p, int octaves, double gain, std::uint32_t seed);

/// 1 - distance to the nearest of random points, one a unit cell: round bumps in [0, 1] with sharp
/// creases between (Worley 1996).
double bumps(const Vec3& p, std::uint32_t seed);

/// Three independent noises, to push points around.
Vec3 perlin_vector(const Vec3& p, int octaves, double gain, std::uint32_t seed);

inline double smooth_step(double lo, double hi, double x) {
  const double t = x <= lo ? 0.0 : x >= hi ? 1.0 : (x - lo) / (hi - lo);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace brume::media
