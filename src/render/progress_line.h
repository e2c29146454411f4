// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace brume {

/// How far a render is, and what will end it.
struct ProgressState {
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  std::uint64_t pixels;
  std::uint64_t samples_before = 0;    // of all pixels, by an earlier run
  std::uint64_t samples = 0;           // by this run
  double target_spp = kUnknown;        // samples a pixel; infinite when they end no render
  double seconds = 0.0;                // since this run's start
  double seconds_limit = kUnknown;     // infinite when time does not end the render
  double error = kUnknown;             // upper bound of the picture's relative RMS error
  std::uint64_t samples_at_error = 0;  // of this run, when that was found
  double target_error = 0.0;           // 0 when the error does not end the render
};

/// One line of at most `columns` characters; a narrow one drops the bar first, then what matters
/// least: ` 43% [====>     ] 27.5/64 spp  0:16 left  error <2.4% to 1%  0:12 elapsed  1.21M
/// samples/s`.
std::string bar_line(const ProgressState& state, int columns);

/// The same for a log, without the bar.
std::string plain_line(const ProgressState& state);

}  // namespace brume
