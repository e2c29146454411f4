// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the scene reader of this folder.

#include <optional>

#include "io/scene_builder.h"
#include "io/volume_file.h"

namespace brume {

/// A coefficient of a heterogeneous medium as its parameter gives it: a colour, a constvolume, or
/// a volume file.
struct SceneVolume {
  std::optional<Rgb> constant;  // the same everywhere, or else `grid`
  glm::dmat4 to_world{1.0};     // of the cube [0, 1]^3 that a constant may have to fill
  AnyGrid grid{};
  std::string source;  // the file, for messages
};

/// The parameter `name` of a medium. Constants lie in [0, 1] for `kReflectance`.
SceneVolume volume_parameter(const SceneNode& medium, std::string_view name, double fallback,
                             ColourUse use, BuildContext& context);

/// The volume as a grid, a constant filling its cube.
AnyGrid as_grid(const SceneVolume& volume);

/// The box around what the grid defines [unit].
Box3 world_bounds(const AnyGrid& grid);

/// Largest value of any channel.
float largest_value(const AnyGrid& grid);

}  // namespace brume
