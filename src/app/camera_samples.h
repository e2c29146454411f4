// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "integrator/path_integrator.h"
#include "io/scene_file.h"
#include "render/render.h"

namespace brume {

/// `path` as it suits a picture: light paths must be shared by many pixels to be worth their cost,
/// and are left out of the whole picture if they are not, so that a part of it has the same pixels.
PathSettings suited_to(const FilmSettings& film, PathSettings path);

/// Camera samples of the part of the picture that is rendered. `integrator` and `film` outlive the
/// function. `independent` replaces the Sobol points by independent numbers.
SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, bool independent);

}  // namespace brume
