// SPDX-License-Identifier: Apache-2.0
#include "app/input.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "io/volume_scene.h"

namespace brume {

bool is_volume_path(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  return extension == ".vdb" || extension == ".nvdb" || extension == ".vol";
}

LoadedScene load_input(const RenderOptions& options, Notices& notices) {
  if (is_volume_path(options.input)) {
    if (!options.definitions.empty())
      throw Error(fmt::format("-D {} sets a parameter of a scene, and {} is a bare volume",
                              options.definitions.begin()->first, options.input));
    VolumeSceneOptions volume{.path = options.input, .grid = options.grid};
    volume.density_scale = options.density_scale;
    if (options.albedo) volume.albedo = *options.albedo;
    if (options.g) volume.g = *options.g;
    if (options.size) volume.size = *options.size;
    volume.settings = options.settings;
    return make_volume_scene(volume, notices);
  }
  if (std::filesystem::path(options.input).extension() != ".xml")
    throw Error(
        fmt::format("{}: the extension says neither scene (.xml) nor volume (.vdb, .nvdb, "
                    ".vol)",
                    options.input));
  if (options.any_volume_option())
    throw Error(
        fmt::format("--grid, --density-scale, --albedo and --g are for a bare volume; {} "
                    "is a scene and says so itself",
                    options.input));
  return load_scene(options.input, options.definitions, notices, options.size, options.settings);
}

void print_notices(const Notices& notices) {
  for (const std::string& notice : notices) fmt::print(stderr, "note: {}\n", notice);
}

}  // namespace brume
