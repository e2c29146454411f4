// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace brume {

/// Linear value in [0, 1] to its sRGB code in [0, 1] (IEC 61966-2-1).
inline float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// sRGB code in [0, 1] to its linear value in [0, 1] (IEC 61966-2-1).
inline float linear_from_srgb(float code) {
  return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

}  // namespace brume
