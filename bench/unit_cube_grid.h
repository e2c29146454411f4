// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanovdb/util/GridBuilder.h>

#include <memory>

#include "volume/grid.h"

namespace brume {

/// A grid of n^3 voxels in the unit cube, 0 outside. `density(voxel)` is left out where it is not
/// positive.
template <class Density>
std::shared_ptr<const Grid<float>> unit_cube_grid(int n, Density&& density) {
  nanovdb::GridBuilder<float> builder(0.0f);
  auto accessor = builder.getAccessor();
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) {
        const float value = density(glm::ivec3(x, y, z));
        if (value > 0.0f) accessor.setValue(nanovdb::Coord(x, y, z), value);
      }
  glm::dmat4 world_from_index(1.0 / n);
  world_from_index[3] = glm::dvec4(0.5 / n, 0.5 / n, 0.5 / n, 1.0);
  return std::make_shared<const Grid<float>>(builder.getHandle<>(), world_from_index,
                                             Box3{Vec3(-0.5f), Vec3(float(n) - 0.5f)},
                                             Interpolation::kTrilinear, Wrap::kBackground);
}

}  // namespace brume
