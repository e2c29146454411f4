// SPDX-License-Identifier: Apache-2.0
#include "geometry/plane_patch.h"

namespace brume {

PlanePatch::PlanePatch(const glm::dmat4& to_world, bool flip_normals)
    : center(to_world[3]), a(to_world[0]), b(to_world[1]), cross(glm::cross(a, b)) {
  const double squared = glm::dot(cross, cross);
  a_dual = glm::cross(b, cross) / squared;
  b_dual = glm::cross(cross, a) / squared;
  // A mirrored transform may take +Z to the other side of a x b.
  const bool is_reversed = glm::dot(cross, Vec3d(to_world[2])) < 0.0;
  n = Vec3(glm::normalize(cross)) * (is_reversed != flip_normals ? -1.0f : 1.0f);
}

}  // namespace brume
