// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/vec.h"

namespace brume {

/// The way from one point to another, in double: squares of distances that fit a float may not.
struct Toward {
  double distance;  // [unit]; `d` means nothing where it is 0
  Vec3 d;           // unit

  Toward(const glm::dvec3& from, const glm::dvec3& to)
      : distance(glm::length(to - from)), d((to - from) / distance) {}

  /// [1/unit^2]
  float inverse_square() const { return static_cast<float>(1.0 / (distance * distance)); }
};

}  // namespace brume
