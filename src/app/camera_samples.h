// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "integrator/path_integrator.h"
#include "io/scene_file.h"
#include "render/render.h"

namespace brume {

/// Camera samples of the part of the picture that is rendered. `integrator` and `film` outlive the
/// function. `independent` replaces the Sobol points by independent numbers.
SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, bool independent);

}  // namespace brume
