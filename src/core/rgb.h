// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/vec.h"

namespace brume {

/// Linear Rec. 709 radiance, or a coefficient per channel. GLM leaves it uninitialised:
/// write `Rgb L{0.0f}`.
using Rgb = glm::vec3;

inline float max_component(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}
inline float min_component(const Rgb& c) {
  return std::min({c.r, c.g, c.b});
}
inline float mean(const Rgb& c) {
  return (c.r + c.g + c.b) * (1.0f / 3.0f);
}
inline bool is_black(const Rgb& c) {
  return c.r == 0.0f && c.g == 0.0f && c.b == 0.0f;
}
inline bool is_grey(const Rgb& c) {
  return c.r == c.g && c.g == c.b;
}

/// Relative luminance of linear Rec. 709 (ITU-R BT.709).
inline float luminance(const Rgb& c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

inline bool is_finite_and_non_negative(const Rgb& c) {
  return c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f && std::isfinite(c.r + c.g + c.b);
}

}  // namespace brume
