// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "integrator/path_settings.h"

namespace brume {

/// Sum of the differences of pixels of two pictures, and how far off from zero it may be by chance.
///
/// Pixels a multiple of `kLightPathSpacing` apart along both axes may share light paths, so that
/// their errors hang together; any others are independent. Each pixel knows its own variance, and
/// by that the variance of the sum is known to lie between two bounds: that of independent pixels,
/// and that of groups whose pixels all err as one. In between, it is taken from the spread of the
/// groups' sums, which are independent of each other whatever goes on inside a group. Where no
/// group has two pixels, the bounds are the same.
class GroupedSum {
 public:
  /// Adds the pixel (x, y), whose difference has `variance`; it may be infinite for `variance()`,
  /// but not for `p()`.
  void add(int x, int y, double difference, double variance);

  std::uint64_t pixels() const { return pixels_; }

  /// Of the sum. A difference that is not by chance and not the same everywhere may add to it.
  double variance() const;

  /// Probability of so large a sum by chance: the less favourable of Student's t for independent
  /// pixels and for groups. A variance that rests on few pixels, or few groups, has few degrees of
  /// freedom (Satterthwaite 1946). Precondition: a pixel was added that has a variance.
  double p() const;

 private:
  static constexpr int kPeriod = kLightPathSpacing;  // [pixel]

  struct Group {
    double difference = 0.0;
    double error = 0.0;  // sum of the standard errors
    std::uint64_t pixels = 0;
  };
  /// What the groups say about the variance of the sum.
  struct Spread {
    double variance;  // from the spread of their sums; infinite when they are too few
    double bound;     // most that it can be
    double degrees;   // of freedom, of `bound`; `variance` has one less
  };
  Spread spread() const;

  std::array<Group, kPeriod * kPeriod> groups_{};
  double difference_ = 0.0;
  double variance_ = 0.0;          // if pixels are independent
  double variance_squares_ = 0.0;  // of the single pixels
  std::uint64_t pixels_ = 0;
};

}  // namespace brume
