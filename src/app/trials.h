// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "io/scene_file.h"
#include "study/trial.h"

namespace brume {

/// What a study of the scene measures: the default first, then samples, depths and every setting
/// that matters to the scene, one changed at a time.
std::vector<Trial> design_trials(const LoadedScene& scene);

/// Clamping of indirect light, for a picture whose mean is `radiance`.
std::vector<Trial> design_clamping_trials(double radiance);

}  // namespace brume
