// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanovdb/util/GridBuilder.h>

#include <memory>

#include "volume/grid.h"

namespace brume::test {

/// Scalar grid of `n` voxels whose value at voxel (x, y, z) is `value(x, y, z)`; cell-centred,
/// clamped at its faces, filling the image of the unit cube under `to_world`.
template <class F>
std::shared_ptr<const Grid<float>> make_grid(
    const glm::ivec3& n, F&& value, const glm::dmat4& to_world = glm::dmat4(1.0),
    Interpolation interpolation = Interpolation::kTrilinear) {
  nanovdb::GridBuilder<float> builder(0.0f);
  auto accessor = builder.getAccessor();
  for (int z = -1; z <= n.z; ++z)
    for (int y = -1; y <= n.y; ++y)
      for (int x = -1; x <= n.x; ++x)
        accessor.setValue(nanovdb::Coord(x, y, z),
                          float(value(std::clamp(x, 0, n.x - 1), std::clamp(y, 0, n.y - 1),
                                      std::clamp(z, 0, n.z - 1))));
  glm::dmat4 unit_from_index(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    unit_from_index[axis][axis] = 1.0 / n[axis];
    unit_from_index[3][axis] = 0.5 / n[axis];
  }
  return std::make_shared<const Grid<float>>(builder.getHandle<>(), to_world * unit_from_index,
                                             Box3{Vec3(-0.5f), Vec3(n) - 0.5f}, interpolation,
                                             Wrap::kClamp);
}

}  // namespace brume::test
