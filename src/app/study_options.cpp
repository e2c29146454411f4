// SPDX-License-Identifier: Apache-2.0
#include "app/study_options.h"

#include <CLI/CLI.hpp>

namespace brume {

void add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App& compare = *app.add_subcommand(
      "compare", "Say how far a picture is from a reference, and whether chance explains it");
  compare.add_option("A", options.picture, "Picture (.exr, .png, .jpg or .hdr)")->required();
  compare.add_option("B", options.reference, "The reference, of the same size")->required();
  compare
      .add_option("-o,--output", options.heat_map_path,
                  "Heat map to write: relative error of each pixel, 0.1% to 100%, with legend")
      ->type_name("HEATMAP");
  compare.add_option("--json", options.json_path, "Write the figures for programs to FILE")
      ->type_name("FILE");
  compare.footer(
      "Errors are differences of linear radiance, averaged over all pixels and channels. Where a\n"
      "picture has error layers (EXR files of brume), the probability that both show the same\n"
      "picture is given: below 0.001 they hardly do. Its assumptions: docs/trade.md.");
}

}  // namespace brume
