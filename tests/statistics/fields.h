// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "statistics/quadrature.h"
#include "support/scene_files.h"

namespace brume::test {

/// A density in double: voxels in [0, 1]^3 under `to_world`, cell-centred, trilinear between their
/// centres and continued to the faces; 0 outside. What a .vol file is by its definition.
struct DensityField {
  glm::ivec3 n;
  std::function<double(int, int, int)> voxel;
  glm::dmat4 to_world{1.0};

  std::string vol() const {
    return vol_bytes(n, 1, [this](int x, int y, int z, int /*channel*/) { return voxel(x, y, z); });
  }

  double at(const glm::dvec3& p) const {
    const glm::dvec3 unit(glm::inverse(to_world) * glm::dvec4(p, 1.0));
    double sum = 0.0;
    glm::dvec3 f;
    glm::ivec3 cell;
    for (int axis = 0; axis < 3; ++axis) {
      if (unit[axis] < 0.0 || unit[axis] > 1.0) return 0.0;
      const double x = unit[axis] * n[axis] - 0.5;
      cell[axis] = int(std::floor(x));
      f[axis] = x - cell[axis];
    }
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      glm::ivec3 i;
      for (int axis = 0; axis < 3; ++axis) {
        const int up = corner >> axis & 1;
        weight *= up ? f[axis] : 1.0 - f[axis];
        i[axis] = std::clamp(cell[axis] + up, 0, n[axis] - 1);
      }
      sum += weight * voxel(i.x, i.y, i.z);
    }
    return sum;
  }

  /// Optical thickness from `a` to `b`.
  double tau(const glm::dvec3& a, const glm::dvec3& b, int panels = 2000) const {
    return glm::length(b - a) *
           integrate(0.0, 1.0, panels, [&](double s) { return at(a + s * (b - a)); });
  }
};

}  // namespace brume::test
