// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "study/trial.h"

namespace brume {

/// Seconds until a picture of the trial has the relative error `target`: its variance falls with
/// the time spent, its bias stays. Nothing where the bias alone may reach the target; it is taken
/// at the upper end of its interval, and for 0 where the trial is not declared biased.
std::optional<double> seconds_to_error(const TrialResult& result, double target);

/// How many times faster than `standard` the trial reaches the error of one of `standard`'s
/// pictures, as estimated; 0 where its bias does not let it.
double efficiency(const TrialResult& result, const TrialResult& standard);

/// Squared relative error after `seconds`, by the same rule with the bias at its estimate.
double squared_error_after(const TrialResult& result, double seconds);

/// What to do for an error.
struct Recommendation {
  double target;           // relative RMSE
  std::size_t trial;       // among the results
  std::uint32_t spp;       // samples a pixel
  double seconds;          // for the picture of the study
  double default_seconds;  // the same with the default
};

/// For each usual target, from a tenth down to a thousandth, the fastest trial. The default, which
/// comes first, gives way only to what is faster by more than the intervals of both, and by a tenth
/// on top of it, or by a half for what is biased. Every trial reaches its targets by its own number
/// of samples: those of a fixed one are passed over.
std::vector<Recommendation> recommend(std::span<const TrialResult> results);

/// The least error that any trial reaches in a time, and by which trial: the Pareto front.
struct FrontPoint {
  double seconds;
  double error;       // relative RMSE
  std::size_t trial;  // among the results
};
/// The front at `count` times from `first` to `last` seconds, equal ratios apart.
std::vector<FrontPoint> pareto_front(std::span<const TrialResult> results, double first,
                                     double last, int count);

}  // namespace brume
