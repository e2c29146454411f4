// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "film/camera_sample.h"
#include "render/progress.h"

namespace brume {

class Film;

/// Camera sample `index` of pixel (x, y): a pure function of the three, called by many threads,
/// that does not throw.
using SampleFunction =
    std::function<CameraSample(std::uint32_t x, std::uint32_t y, std::uint32_t index)>;

/// The stop rule that is reached first ends the render. With neither, only an interrupt does.
struct RenderSettings {
  static constexpr std::uint32_t kUnlimited = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t spp = kUnlimited;                            // samples a pixel
  double seconds = std::numeric_limits<double>::infinity();  // of rendering
  int threads = 0;                                           // 0 for all that the machine has
  ProgressStyle progress = ProgressStyle::kQuiet;
};

enum class StopReason { kSampleCount, kTimeLimit, kInterrupted };

struct RenderResult {
  StopReason reason;
  double seconds;
  std::uint32_t min_spp;  // samples of the pixel that has the fewest
  double mean_spp;        // samples a pixel; bad ones are not among them
};

/// Fills the empty `film` pass by pass until a stop rule or an `interrupt_requested()` ends it;
/// what was rendered is kept. Each pixel's samples are added in order of their index, so that
/// after the same number of samples the film holds the same bits for any number of threads.
RenderResult render(const SampleFunction& sample, const RenderSettings& settings, Film& film);

}  // namespace brume
