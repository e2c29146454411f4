// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdlib>
#include <exception>

#include "cell.h"

/// Renders the matrix and writes a line of CSV for each channel of each cell. `known` tells what is
/// known of it: the value, another scene whose render is the same, or only that it is sound.
/// Arguments: how many times the short
/// run's samples (1), and a part of the names of the cells wanted (all).
int main(int argc, char** argv) {
  using namespace brume::test;
  const double factor = argc > 1 ? std::atof(argv[1]) : 1.0;
  const std::string wanted = argc > 2 ? argv[2] : "";
  fmt::print(
      "axis,at,name,channel,known,want,mean,standard_error,z,samples,bad,violations,seconds\n");
  for (const Cell& cell : all_cells()) {
    if (cell.name.find(wanted) == std::string::npos) continue;
    const char* known = cell.want ? "value" : !cell.like.empty() ? "render" : "soundness";
    const int blocks = std::max(8, int(cell.blocks * factor));
    try {
      const Outcome got = measure(cell, cell.scene, blocks);
      std::array<RunningMean, 3> like;
      if (!cell.like.empty()) like = measure(cell, cell.like, blocks).L;
      for (int c = 0; c < 3; ++c) {
        const double want = cell.want ? (*cell.want)[c] : !cell.like.empty() ? like[c].mean() : NAN;
        const double error = std::hypot(got.L[c].standard_error(),
                                        cell.like.empty() ? 0.0 : like[c].standard_error());
        fmt::print("\"{}\",{:g},{},{},{},{:.9g},{:.9g},{:.3g},{:.2f},{},{},{},{:.3f}\n", cell.axis,
                   cell.at, cell.name, "rgb"[c], known, want, got.L[c].mean(), error,
                   (got.L[c].mean() - want) / error, got.samples, got.bad_samples, got.violations,
                   got.seconds);
      }
      std::fflush(stdout);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}: {}\n", cell.name, e.what());
    }
  }
}
