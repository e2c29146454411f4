// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace brume {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kPi = 3.14159265358979323846f;
/// Largest float below 1: the top of every interval [0, 1) of random numbers.
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

inline float length_squared(const Vec3& v) {
  return glm::dot(v, v);
}

/// 1 - cos of the angle between the unit vectors `a` and `b`, without the cancellation of
/// 1 - dot(a, b) for small angles: |a - b|^2 / 2.
inline float one_minus_cos(const Vec3& a, const Vec3& b) {
  return 0.5f * length_squared(a - b);
}

/// Largest absolute component.
inline float max_abs(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace brume
