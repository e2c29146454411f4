// SPDX-License-Identifier: Apache-2.0
#include "study/grouped_sum.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "study/student.h"

namespace brume {

void GroupedSum::add(int x, int y, double difference, double variance) {
  Group& group = groups_[std::size_t(y % kPeriod * kPeriod + x % kPeriod)];
  group.difference += difference;
  group.error += std::sqrt(variance);
  group.pixels += 1;
  difference_ += difference;
  variance_ += variance;
  variance_squares_ += variance * variance;
  pixels_ += 1;
}

GroupedSum::Spread GroupedSum::spread() const {
  double squares = 0.0, shares_squared = 0.0, bound = 0.0, bound_squares = 0.0;
  for (const Group& group : groups_) {
    // A bias that all pixels have is no spread: each group is held against its share of the sum.
    const double share = double(group.pixels) / double(pixels_);
    const double rest = group.difference - share * difference_;
    squares += rest * rest;
    shares_squared += share * share;
    const double shared = group.error * group.error;
    bound += shared;
    bound_squares += shared * shared;
  }
  // With variances in proportion to the shares, the expectation of `squares` is the variance of the
  // sum times this; with G groups of one size, (G - 1) / G.
  const double part = 1.0 - shares_squared;
  return {.variance = part > 0.0 ? squares / part : INFINITY,
          .bound = bound,
          .degrees = bound * bound / bound_squares};
}

double GroupedSum::variance() const {
  const Spread groups = spread();
  return std::max(variance_, std::min(groups.variance, groups.bound));
}

double GroupedSum::p() const {
  assert(variance_ > 0.0 && std::isfinite(variance_));
  const auto p_with = [this](double variance, double degrees) {
    return student_two_sided(difference_ / std::sqrt(variance), degrees);
  };
  const Spread groups = spread();
  const double p_independent = p_with(variance_, variance_ * variance_ / variance_squares_);
  const double p_bound = p_with(groups.bound, groups.degrees);
  // A difference in a few pixels widens the spread beyond anything that light paths could do.
  const bool knows_spread = groups.degrees > 1.0 && groups.variance < groups.bound;
  const double p_groups = knows_spread ? p_with(groups.variance, groups.degrees - 1.0) : p_bound;
  return std::max(p_independent, p_groups);
}

}  // namespace brume
