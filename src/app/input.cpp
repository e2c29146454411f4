// SPDX-License-Identifier: Apache-2.0
#include "app/input.h"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>

#include "core/error.h"
#include "io/volume_scene.h"

namespace brume {

namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace

bool is_volume_path(const std::string& path) {
  const std::string extension = extension_of(path);
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
  if (extension_of(options.input) != ".xml")
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

void print_notices(const Notices& notices, bool quiet) {
  for (const Notice& notice : notices.all())
    if (notice.is_warning)
      fmt::print(stderr, "warning: {}\n", notice.text);
    else if (!quiet)
      fmt::print(stderr, "note: {}\n", notice.text);
}

}  // namespace brume
