// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace brume {

/// How far a render is, and what will end it.
struct ProgressState {
  std::uint64_t pixels;
  std::uint64_t samples;  // done, of all pixels
  double target_spp;      // samples a pixel; infinite when only time ends the render
  double seconds;         // since the start
  double seconds_limit;   // infinite when only the sample count ends the render
};

/// One line of at most `columns` characters; a narrow one drops the bar first, then what matters
/// least: ` 43% [====>     ] 27.5/64 spp  1.21M samples/s  0:12 elapsed  0:16 left`.
std::string bar_line(const ProgressState& state, int columns);

/// The same for a log, without the bar.
std::string plain_line(const ProgressState& state);

}  // namespace brume
