// SPDX-License-Identifier: Apache-2.0
#include "study/recommendation.h"

#include <algorithm>
#include <cmath>

namespace brume {
namespace {

constexpr double kTargets[] = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

double squared_bias_limit(const TrialResult& result) {
  if (!result.trial.biased) return 0.0;
  const Estimate& bias = result.accuracy.squared_bias;
  return std::max(bias.value, 0.0) + bias.error;
}

/// Half width of the interval of the cost, relative.
double uncertainty(const TrialResult& result) {
  return result.accuracy.squared_error.error / result.accuracy.squared_error.value;
}

}  // namespace

double efficiency(const TrialResult& result, const TrialResult& standard) {
  const double bias = result.trial.biased ? std::max(result.accuracy.squared_bias.value, 0.0) : 0.0;
  const double for_noise = standard.accuracy.variance - bias;
  return for_noise > 0.0 ? standard.seconds * for_noise / result.cost() : 0.0;
}

std::optional<double> seconds_to_error(const TrialResult& result, double target) {
  const double for_noise = target * target - squared_bias_limit(result);
  if (!(for_noise > 0.0)) return std::nullopt;
  return result.cost() / for_noise;
}

double squared_error_after(const TrialResult& result, double seconds) {
  const double bias = result.trial.biased ? std::max(result.accuracy.squared_bias.value, 0.0) : 0.0;
  return bias + result.cost() / seconds;
}

std::vector<Recommendation> recommend(std::span<const TrialResult> results) {
  std::vector<Recommendation> list;
  for (const double target : kTargets) {
    const std::optional<double> by_default = seconds_to_error(results.front(), target);
    std::size_t best = 0;
    double best_merit = *by_default * (1.0 - uncertainty(results.front()));
    for (std::size_t i = 1; i < results.size(); ++i) {
      if (results[i].trial.spp) continue;
      const auto seconds = seconds_to_error(results[i], target);
      if (!seconds) continue;
      const double handicap = results[i].trial.biased ? 1.5 : 1.1;
      const double merit = *seconds * (1.0 + uncertainty(results[i])) * handicap;
      if (merit < best_merit) {
        best = i;
        best_merit = merit;
      }
    }
    const TrialResult& chosen = results[best];
    const double seconds = *seconds_to_error(chosen, target);
    const double spp = std::ceil(chosen.spp * seconds / chosen.seconds);
    list.push_back({.target = target,
                    .trial = best,
                    .spp = std::uint32_t(std::clamp(spp, 1.0, 4e9)),
                    .seconds = seconds,
                    .default_seconds = *by_default});
  }
  return list;
}

std::vector<FrontPoint> pareto_front(std::span<const TrialResult> results, double first,
                                     double last, int count) {
  std::vector<FrontPoint> front;
  for (int i = 0; i < count; ++i) {
    const double seconds = first * std::pow(last / first, double(i) / (count - 1));
    FrontPoint point{.seconds = seconds, .error = INFINITY, .trial = 0};
    for (std::size_t trial = 0; trial < results.size(); ++trial) {
      const double error = std::sqrt(squared_error_after(results[trial], seconds));
      if (error < point.error) point = {seconds, error, trial};
    }
    front.push_back(point);
  }
  return front;
}

}  // namespace brume
