// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace brume {

class Film;

/// A render goes in rounds. The first gives each pixel one block of samples, each further one
/// an eighth more than there were, and at least one block: the blocks that a pixel has
/// on average after the round that aimed at `blocks`; 0 before the first. A fixed sequence,
/// so that a render that was asked for less has done what one that is asked for more does first.
/// It ends, and stays at its last value, with the last sample index.
std::uint32_t next_round(std::uint32_t blocks);
/// The round before, whose next_round() is `blocks`; 0 for the first.
std::uint32_t round_before(std::uint32_t blocks);

/// Samples that pixels are to have at the end of a round.
struct SamplePlan {
  std::uint32_t even = 0;               // each, when `uneven` is empty
  std::vector<std::uint32_t> uneven{};  // [height][width]

  std::uint32_t samples(std::size_t pixel) const { return uneven.empty() ? even : uneven[pixel]; }
};

/// As many for each.
SamplePlan even_plan(std::uint32_t blocks);

/// More for noisy and cheap pixels, in proportion to the standard deviation over the root of the
/// cost (Neyman 1934), which gives the least error for the time; between an eighth and eight times
/// `blocks`, so that what looks dark and quiet is still looked at.
///
/// What a pixel gets is decided by the pixels around it and never by its own samples, and by
/// samples whose number was fixed beforehand (PixelGuide), so that its mean stays unbiased. Only
/// the scale that all pixels share depends on all of them. Requires the film's guide layer and
/// that the rounds before were made.
SamplePlan adaptive_plan(const Film& film, std::uint32_t blocks);

}  // namespace brume
