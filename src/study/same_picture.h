// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "study/picture.h"

namespace brume {

/// Whether two pictures differ by more than their standard errors explain.
///
/// z is the difference of a pixel's channel over its standard error. Pixels know their own error
/// from few samples, so that z spreads wider than a normal variable even between renders of the
/// same scene, and its mean square is for the eye. `p_same` is for decisions: it tests the sums of
/// the differences over whole blocks of pixels, and over the whole picture, against what chance
/// does to such sums (GroupedSum: pixels that share light paths are not taken for independent). The
/// blocks' probabilities, which need not be independent, are joined by the Cauchy combination (Liu
/// and Xie 2020). It assumes that a block has enough samples for its sum to be nearly symmetric.
struct SamePicture {
  std::uint64_t compared = 0;    // values (pixels times channels) with a finite, positive error
  std::uint64_t unknown = 0;     // left out: an error is infinite
  std::uint64_t impossible = 0;  // differ although both claim to be exact
  double mean_square_z = 0.0;    // 1 when the errors are right; 0 when nothing was compared
  double share_beyond_3 = 0.0;   // of |z|; 0.0027 of a normal variable
  double p_same = 1.0;           // small: not two pictures of the same scene
};

/// Pictures have the same size, and at least one has errors; one without is taken for exact.
SamePicture test_same_picture(const Picture& a, const Picture& b);

}  // namespace brume
