// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// How collisions in a grid are found. All choices have the same expectation.
struct TrackingSettings {
  enum class Bounds { kCells, kGlobal };
  enum class Lookup { kStochastic, kTrilinear };

  Bounds bounds = Bounds::kCells;       // a majorant for each cell, or one for the grid
  Lookup lookup = Lookup::kStochastic;  // one voxel chosen by its weight, or all eight
  bool control = true;                  // the minimum of a cell is passed in closed form
};

}  // namespace brume
