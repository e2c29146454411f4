// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/vec.h"

namespace brume {

glm::dmat4 translation(const glm::dvec3& offset);
glm::dmat4 scaling(const glm::dvec3& factors);
/// Rotation by `angle_deg` around `axis`, which is not zero, counterclockwise seen against it.
glm::dmat4 rotation(const glm::dvec3& axis, double angle_deg);
/// Moves the origin to `origin` with +Z toward `target` and +X to the left as seen from there.
/// `up` may be zero, in which case some direction is taken. Not finite when `target` is `origin`
/// or lies straight along `up` from it.
glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up);

}  // namespace brume
