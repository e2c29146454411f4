// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "medium/medium.h"
#include "volume/field.h"
#include "volume/grid.h"

namespace brume {

/// A grid crossed in steps of `step` voxels, each with the extinction of one point inside it, as
/// renderers did before null collisions (Perlin and Hoffert 1989). The point lies at the same
/// random place in every step of a ray. Biased: the exponential of an uncertain optical thickness
/// is too large on average, by more the longer the steps. `density_scale`, `albedo` and `phase` as
/// for `make_heterogeneous_medium`.
template <class Stored>
std::shared_ptr<const Medium> make_marched_medium(std::shared_ptr<const Grid<Stored>> density,
                                                  float density_scale,
                                                  std::shared_ptr<const ColorField> albedo,
                                                  HenyeyGreenstein phase, float step);

}  // namespace brume
