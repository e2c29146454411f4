// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the volume readers of this folder, see grid_file.h. The grids are OpenVDB grids of
// float or Vec3f.

#include <glm/mat4x4.hpp>
#include <string>

#include "io/vol_file.h"
#include "volume/grid.h"

namespace brume {

/// Fills an empty grid with background 0, the first voxel at the origin. Throws an Error when a
/// voxel is NaN or infinite.
template <class OpenGrid>
void fill_from_vol(OpenGrid& grid, const VolHeader& vol, const NextLayers& next_layers,
                   const glm::dmat4& world_from_index, const std::string& label);

/// Stores the voxels that lie one step outside 0 .. n - 1.
template <class OpenGrid>
void add_wrapped_layer(OpenGrid& grid, const glm::ivec3& n, Wrap wrap);

}  // namespace brume
