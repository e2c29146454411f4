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

/// Whether it pays that pixels which share light paths go on at paces of their own: those that are
/// ahead take more light paths than the others, which must cost little.
bool suits_adaptive_sampling(const FilmSettings& film);

/// Which light paths a block of samples of a pixel meets, of those of its turn, where pixels a
/// multiple of kLightPathSpacing apart have `sets_across` squared sets. Blocks that follow each
/// other meet different ones, as long as there are some, and pixels less than the spacing apart
/// never the same: adaptive sampling lets them decide for each other.
std::uint32_t light_path_group(std::uint32_t column, std::uint32_t row, std::uint32_t block,
                               std::uint32_t sets_across);

struct CameraSampling {
  bool independent = false;  // numbers instead of Sobol points
  bool adaptive = false;     // pixels go on at paces of their own
};
/// Camera samples of the part of the picture that is rendered. `integrator` and `film` outlive the
/// function.
SampleFunction camera_samples(const PathIntegrator& integrator, const FilmSettings& film,
                              std::uint64_t seed, const CameraSampling& how);

}  // namespace brume
