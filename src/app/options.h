// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "io/estimator_settings.h"

namespace brume {

/// `brume render`, as written on the command line; empty where nothing was said.
struct RenderOptions {
  std::string input;
  std::vector<std::string> outputs{};
  std::optional<std::uint32_t> spp{};
  std::optional<double> seconds{};
  std::optional<double> error{};  // relative RMS, 0.01 is one percent
  bool adaptive = true;
  std::optional<glm::ivec2> size{};  // [pixel]
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all processors
  std::optional<int> max_depth{};
  std::map<std::string, std::string> definitions{};
  std::vector<std::string> layers{};
  float exposure = 0.0f;  // [stops]
  EstimatorSettings settings{};
  bool quiet = false;
  std::string statistics_path{};             // empty: none
  std::optional<double> checkpoint_every{};  // [s]
  bool resume = false;

  // For a bare volume.
  std::string grid{};
  std::optional<float> density_scale{};  // [1/unit] per density
  std::optional<Rgb> albedo{};
  std::optional<float> g{};

  bool any_volume_option() const { return !grid.empty() || density_scale || albedo || g; }
  /// A render that only counts samples gives each pixel as many as it was told.
  bool is_adaptive() const { return adaptive && (seconds || error); }
  bool keeps_checkpoint() const { return checkpoint_every || resume; }
};

/// `brume compare`.
struct CompareOptions {
  std::string picture, reference;
  std::string heat_map_path{};  // empty: none
  std::string json_path{};      // empty: none
};

/// `brume trade`.
struct TradeOptions {
  RenderOptions render{};        // of the input; without outputs and stop rules
  double budget = 300.0;         // [s] for everything
  std::string report_path{};     // .html; empty: INPUT's name in the current folder
  std::string reference_path{};  // empty: one is made
};

/// `brume info`.
struct InfoOptions {
  std::string input;
  std::map<std::string, std::string> definitions;
};

}  // namespace brume
