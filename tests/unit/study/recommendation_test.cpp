// SPDX-License-Identifier: Apache-2.0
#include "study/recommendation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brume {
namespace {

/// A trial of 16 samples in `seconds` with the given relative variance and bias.
TrialResult result(double seconds, double variance, double bias = 0.0, double bias_interval = 0.0) {
  TrialResult r{.trial = {.name = "x", .group = "x", .biased = bias > 0.0},
                .spp = 16,
                .seeds = 4,
                .seconds = seconds,
                .memory_bytes = 0,
                .accuracy = {},
                .picture = {},
                .mean = {}};
  r.accuracy.variance = variance;
  r.accuracy.squared_bias = {.value = bias * bias, .error = bias_interval};
  r.accuracy.squared_error = {.value = bias * bias + variance};
  return r;
}

TEST(Recommendation, TimeToAnErrorFollowsTheVariance) {
  EXPECT_DOUBLE_EQ(*seconds_to_error(result(2.0, 1e-4), 0.001), 200.0);
  // Bias of 0.6 leaves 0.8 of the error to noise; a bias of the whole error leaves nothing.
  EXPECT_DOUBLE_EQ(*seconds_to_error(result(2.0, 1e-4, 0.006), 0.01), 2.0 / 0.64);
  EXPECT_FALSE(seconds_to_error(result(2.0, 1e-4, 0.01), 0.01));
  EXPECT_FALSE(seconds_to_error(result(2.0, 1e-4, 0.006, 7e-5), 0.01));
  EXPECT_DOUBLE_EQ(squared_error_after(result(2.0, 1e-4, 0.01), 4.0), 1.5e-4);
}

TEST(Recommendation, TheDefaultGivesWayToWhatIsClearlyFasterOnly) {
  const auto chosen = [](const TrialResult& other) {
    const TrialResult both[] = {result(1.0, 1e-2), other};
    return recommend(both).front().trial;
  };
  EXPECT_EQ(chosen(result(0.95, 1e-2)), 0u);
  EXPECT_EQ(chosen(result(0.85, 1e-2)), 1u);
  EXPECT_EQ(chosen(result(0.85, 1e-2, 1e-6)), 0u);
  EXPECT_EQ(chosen(result(0.5, 1e-2, 1e-6)), 1u);
}

TEST(Recommendation, WhatNoiseMayExplainIsNotFaster) {
  TrialResult fast = result(0.5, 1e-2);
  const auto chosen = [&] {
    const TrialResult both[] = {result(1.0, 1e-2), fast};
    return recommend(both).front().trial;
  };
  EXPECT_EQ(chosen(), 1u);
  fast.accuracy.squared_error.error = 0.7 * 1e-2;
  EXPECT_EQ(chosen(), 1u);
  fast.accuracy.squared_error.error = 0.9 * 1e-2;
  EXPECT_EQ(chosen(), 0u);
}

TEST(Recommendation, EfficiencyIsTheRatioOfTimesToTheSameError) {
  const TrialResult standard = result(1.0, 1e-2);
  EXPECT_DOUBLE_EQ(efficiency(standard, standard), 1.0);
  EXPECT_DOUBLE_EQ(efficiency(result(0.5, 1e-2), standard), 2.0);
  EXPECT_DOUBLE_EQ(efficiency(result(0.5, 1e-2, 0.06), standard), 2.0 * 0.64);
  EXPECT_EQ(efficiency(result(0.5, 1e-4, 0.2), standard), 0.0);
}

TEST(Recommendation, FastAndBiasedIsForLargeErrorsOnly) {
  const TrialResult both[] = {result(1.0, 1e-2), result(0.1, 1e-2, 0.008)};
  for (const Recommendation& r : recommend(both)) {
    EXPECT_EQ(r.trial, r.target > 0.009 ? 1u : 0u) << r.target;
    EXPECT_LE(r.seconds, r.default_seconds);
    const double noise = both[r.trial].accuracy.variance * 16.0 / r.spp;
    const double bias = both[r.trial].accuracy.squared_bias.value;
    EXPECT_LE(std::sqrt(noise + bias), r.target);
    // Whole samples are one too many at most.
    EXPECT_GE(std::sqrt(both[r.trial].accuracy.variance * 16.0 / (r.spp - 1.0) + bias), r.target);
  }
}

TEST(ParetoFront, IsTheLeastErrorOfAll) {
  const TrialResult both[] = {result(1.0, 1e-2), result(0.1, 1e-2, 0.01)};
  const auto front = pareto_front(both, 0.1, 1000.0, 50);
  ASSERT_EQ(front.size(), 50u);
  EXPECT_EQ(front.front().trial, 1u);
  EXPECT_EQ(front.back().trial, 0u);
  for (std::size_t i = 1; i < front.size(); ++i) {
    EXPECT_LE(front[i].error, front[i - 1].error);
    EXPECT_GT(front[i].seconds, front[i - 1].seconds);
  }
}

}  // namespace
}  // namespace brume
