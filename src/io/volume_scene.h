// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "io/scene_file.h"

namespace brume {

/// A volume file to be seen without a scene of its own.
struct VolumeSceneOptions {
  std::string path;
  std::string grid;                      // selector; empty: chosen
  std::optional<float> density_scale{};  // [1/unit] per density; empty: from the optical thickness
  Rgb albedo{0.99f};                     // white and high, like water and ice
  float g = 0.75f;                       // forward, like droplets
  glm::ivec2 size{960, 720};             // [pixel]
  EstimatorSettings settings{};
};

/// A camera that frames the volume, +Y up, and the sun and sky of a clear day that light it from
/// the side and behind. Every choice is a notice.
LoadedScene make_volume_scene(const VolumeSceneOptions& options, Notices& notices);

}  // namespace brume
