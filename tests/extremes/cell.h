// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"

namespace brume::test {

/// A scene at an extreme, and what is known about its picture of one pixel.
struct Cell {
  std::string axis;   // what is extreme
  double at;          // how extreme: the abscissa of the chart
  std::string name;   // letters and digits, unique
  std::string scene;  // in the scene language
  std::function<void(const TemporaryFolder&)> write_files{};  // that the scene refers to
  bool central_ray = false;          // samples see the middle of the pixel, not all of it
  std::optional<glm::dvec3> want{};  // radiance; none where only soundness is known
  std::string like{};                // or a scene that has the same radiance
  double rounding = 1e-5;            // relative error that the floats of a path may add
  int blocks = 256;                  // of `Sampler::kBlock` samples, in the short run
};

/// Radiance below which floats lose digits [W/(m^2 sr)].
inline constexpr double kFaintest = 1e-37;

/// What a renderer made of a cell.
struct Outcome {
  std::array<RunningMean, 3> L;  // of blocks, which are independent
  std::int64_t samples = 0;
  std::int64_t bad_samples = 0;  // NaN, infinite or negative
  std::uint64_t violations = 0;  // of majorants
  double seconds = 0.0;          // of rendering
};

/// Renders `scene`, which is that of the cell or the one it is like, as the program does. Each cell
/// has samples of its own.
Outcome measure(const Cell& cell, const std::string& scene, int blocks);

/// The whole matrix.
std::vector<Cell> all_cells();

// Its parts, a file each.
std::vector<Cell> cells_of_coefficients();
std::vector<Cell> cells_of_phase();
std::vector<Cell> cells_of_size();
std::vector<Cell> cells_of_grids();
std::vector<Cell> cells_of_views();
std::vector<Cell> cells_of_lights();
std::vector<Cell> cells_of_boundaries();
std::vector<Cell> cells_of_coincidences();

}  // namespace brume::test
