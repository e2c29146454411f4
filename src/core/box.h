// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/vec.h"

namespace brume {

/// Axis-aligned box [min, max]; empty until extended.
struct Box3 {
  Vec3 min{kInfinity};
  Vec3 max{-kInfinity};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  Vec3 center() const { return 0.5f * min + 0.5f * max; }
  Vec3 size() const { return max - min; }
  bool contains(const Vec3& p) const {
    return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y &&
           p.z <= max.z;
  }
  void extend(const Vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void extend(const Box3& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
};

}  // namespace brume
