// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/precise.h"

namespace brume {

/// A transform that keeps angles: p -> offset + scale * rotation * p.
struct Similarity {
  Vec3d offset;    // [unit]
  double scale;    // positive
  Mat3d rotation;  // orthonormal; its determinant is -1 for a mirrored transform
};

/// The parts of `to_world`; nothing when it shears, scales its axes differently by more than a
/// millionth, or is singular. Spheres and cylinders need a similarity.
std::optional<Similarity> as_similarity(const glm::dmat4& to_world);

}  // namespace brume
