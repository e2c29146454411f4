// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "medium/medium.h"
#include "medium/tracking_settings.h"
#include "volume/field.h"
#include "volume/grid.h"

namespace brume {

/// Medium whose extinction is a grid: `sigma_t` = density * `density_scale` [1/unit], vacuum
/// outside the grid's box. Both go along the cells of a bounds grid, whose minima need no lookups:
/// free flights by decomposition tracking (Kutz et al. 2017), transmittance by residual ratio
/// tracking (Novak et al. 2014).
/// A coloured density is tracked in all channels at once with one scalar majorant and collision
/// probabilities that follow the throughput (Kutz et al. 2017).
/// `albedo` in [0, 1] is read at real collisions only.
std::shared_ptr<const Medium> make_heterogeneous_medium(std::shared_ptr<const Grid<float>> density,
                                                        float density_scale,
                                                        std::shared_ptr<const ColorField> albedo,
                                                        HenyeyGreenstein phase,
                                                        const TrackingSettings& settings = {});
std::shared_ptr<const Medium> make_heterogeneous_medium(std::shared_ptr<const Grid<Rgb>> density,
                                                        float density_scale,
                                                        std::shared_ptr<const ColorField> albedo,
                                                        HenyeyGreenstein phase,
                                                        const TrackingSettings& settings = {});

}  // namespace brume
