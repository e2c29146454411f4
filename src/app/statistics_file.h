// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "film/picture_error.h"
#include "io/estimator_settings.h"
#include "render/render.h"

namespace brume {

/// What a render reports about itself, on the terminal, in picture files and for programs.
struct RenderStatistics {
  std::string input;
  std::vector<std::string> outputs;
  glm::ivec2 size;
  std::uint64_t seed;
  EstimatorSettings settings;
  RenderResult result;
  double load_seconds;
  PictureError error;
  std::optional<BadSamples> bad_samples;
};

/// Why the render stopped, in words.
std::string describe(StopReason reason);

/// Writes JSON. Throws an Error when the file cannot be written.
void write_statistics(const std::string& path, const RenderStatistics& statistics);

}  // namespace brume
