// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "film/camera_sample.h"
#include "film/picture_error.h"
#include "render/progress.h"

namespace brume {

class Film;

/// Camera sample `index` of pixel (x, y), drawn in `turn`: a pure function of the four, called by
/// many threads, that does not throw. Pixels go on in turns, one block of samples in each on
/// average, so that they may share what is made for a turn.
using SampleFunction = std::function<CameraSample(std::uint32_t x, std::uint32_t y,
                                                  std::uint32_t index, std::uint32_t turn)>;

/// How far a render has come, besides the samples in its film.
struct RenderState {
  std::uint32_t blocks = 0;  // a pixel on average, that the latest round aims at
  double seconds = 0.0;      // of rendering
};

/// Saves what was rendered so far; does not throw. Samples rest meanwhile.
using CheckpointFunction = std::function<void(const RenderState&)>;

/// The stop rule that is reached first ends the render. With none, only an interrupt does.
struct RenderSettings {
  static constexpr std::uint32_t kUnlimited = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t spp = kUnlimited;  // samples of any pixel
  double seconds =
      std::numeric_limits<double>::infinity();  // of rendering, before this not counted
  double error = 0.0;     // to bring the upper bound of the picture's error below; 0 for none
  bool adaptive = false;  // more samples where the error is; requires the film's guide layer
  int threads = 0;        // 0 for all that the machine has
  ProgressStyle progress = ProgressStyle::kQuiet;
  CheckpointFunction save_checkpoint{};                                  // none: never
  double checkpoint_interval = std::numeric_limits<double>::infinity();  // [s]
};

enum class StopReason { kSampleCount, kTimeLimit, kErrorTarget, kInterrupted };

struct RenderResult {
  StopReason reason;
  RenderState state;
  std::uint32_t min_spp;  // samples of the pixel that has the fewest
  double mean_spp;        // samples a pixel; bad ones are not among them
};

/// Adds samples to `film`, which is empty or as an earlier render left it with `state`, round by
/// round until a stop rule or an `interrupt_requested()` ends it; what was rendered is kept. Each
/// pixel's samples are added in order of their index, and a round is planned from what the rounds
/// before have brought, so that the film holds the same bits for any number of threads and however
/// often the render was interrupted.
RenderResult render(const SampleFunction& sample, const RenderSettings& settings, Film& film,
                    const RenderState& state = {});

}  // namespace brume
