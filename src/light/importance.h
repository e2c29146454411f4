// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace brume {

/// `importance` >= 0, or infinite beside a point light, kept where sums of it are finite.
inline float finite(float importance) {
  return std::min(importance, 1e30f);
}

}  // namespace brume
