// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "app/commands.h"
#include "app/input.h"
#include "io/volume_file.h"

namespace brume {
namespace {

void print_volume(const std::string& path) {
  const std::vector<GridSummary> grids = list_grids(path);
  fmt::print("{}: {} grid{}\n", path, grids.size(), grids.size() == 1 ? "" : "s");
  for (const GridSummary& grid : grids) fmt::print("  {}\n", describe(grid));
}

void print_requirements(const LoadedScene& loaded) {
  fmt::print("picture {}x{}, {} samples a pixel\n", loaded.film.crop_size.x,
             loaded.film.crop_size.y, loaded.sample_count);
  fmt::print("rendering requires\n");
  for (const Requirement& requirement : loaded.scene->requirements())
    fmt::print("  {:3} {:<24} {}\n", requirement.required ? "yes" : "no", requirement.machinery,
               requirement.reason);
}

}  // namespace

int run_info(const InfoOptions& options) {
  if (is_volume_path(options.input)) print_volume(options.input);
  Notices notices;
  const LoadedScene loaded =
      load_input({.input = options.input, .definitions = options.definitions}, notices);
  print_notices(notices, /*quiet=*/false);
  print_requirements(loaded);
  return 0;
}

}  // namespace brume
