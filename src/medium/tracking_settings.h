// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// How collisions in a grid are found. Choices have the same expectation unless they say "biased".
struct TrackingSettings {
  enum class Bounds { kCells, kGlobal };
  enum class Lookup { kStochastic, kTrilinear, kNearest };
  enum class Storage { kFloat, k16Bit, k8Bit };

  Bounds bounds = Bounds::kCells;       // a majorant for each cell, or one for the grid
  Lookup lookup = Lookup::kStochastic;  // one voxel chosen by its weight, or all eight;
                                        // the nearest one is biased
  bool control = true;                  // the minimum of a cell is passed in closed form
  bool roulette = true;                 // ends transmittances that have become small
  float march_step = 0.0f;              // [voxels] of fixed steps instead, biased; 0: none
  Storage storage = Storage::kFloat;    // of scalar grids; fewer bits are biased
  bool similar_media = false;           // built for light that has scattered often, see Medium

  bool operator==(const TrackingSettings&) const = default;
};

}  // namespace brume
