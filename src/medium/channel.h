// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"

namespace brume {

/// Probability of each colour channel, in proportion to `c` >= 0; uniform where all are 0.
inline Rgb normalized_or_uniform(const Rgb& c) {
  const float largest = max_component(c);
  if (!(largest > 0.0f)) return Rgb{1.0f / 3.0f};
  const Rgb scaled = c / largest;
  return scaled / (scaled.r + scaled.g + scaled.b);
}

/// Channel 0, 1 or 2 with probability `p`, by `u` in [0, 1).
inline int sample_channel(const Rgb& p, float u) {
  if (u < p.r) return 0;
  return u < p.r + p.g || p.b == 0.0f ? 1 : 2;
}

}  // namespace brume
