// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "dense_grid.h"

namespace brume::media {

/// Densities in [0, 1], y up. Each is the same on every run.
DenseGrid<float> make_cloud();
DenseGrid<float> make_fog_bank();

struct Smoke {
  DenseGrid<float> density;      // [0, 1]
  DenseGrid<float> temperature;  // [0, 1], 1 at the sources
  DenseGrid<glm::vec3> albedo;   // linear Rec. 709, where there is density and around it
};

/// Two plumes of different colour that rise and mix, from a simulation of a minute or two.
Smoke make_smoke();

}  // namespace brume::media
