// SPDX-License-Identifier: Apache-2.0
#include "study/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/statistics.h"
#include "unit/study/pictures.h"

namespace brume {
namespace {

constexpr int kWidth = 30, kHeight = 20;
constexpr float kNoise = 0.3f, kReferenceNoise = 0.1f;

/// Uniform noise of the given standard deviation around `level`.
Image noisy(float level, float deviation, std::uint64_t seed) {
  Rng rng(seed);
  const auto draw = [&] {
    return level + deviation * std::sqrt(12.0f) * (rng.next_float() - 0.5f);
  };
  return test::picture(kWidth, kHeight, [&](int, int) { return Rgb(draw(), draw(), draw()); });
}

Reference noisy_reference(std::uint64_t seed) {
  return reference_of_halves(noisy(2.0f, kReferenceNoise, 10 * seed + 1),
                             noisy(2.0f, kReferenceNoise, 10 * seed + 2));
}

std::vector<Image> seeds(float level, std::uint64_t seed) {
  return {noisy(level, kNoise, 10 * seed + 3), noisy(level, kNoise, 10 * seed + 4),
          noisy(level, kNoise, 10 * seed + 5)};
}

TEST(Accuracy, SquaredErrorIsBiasSquaredPlusVariance) {
  for (const float bias : {0.0f, 0.02f, -0.5f}) {
    test::RunningMean squared_error, squared_bias, mean_bias;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Accuracy a = measure_accuracy(seeds(2.0f + bias, i), noisy_reference(i));
      squared_error.add(a.squared_error.value);
      squared_bias.add(a.squared_bias.value);
      mean_bias.add(a.mean_bias.value);
    }
    // In units of the reference's mean radiance, 2, which has its own small noise.
    constexpr double kUnit = 4.0, kReferenceMean = 1e-6;
    EXPECT_TRUE(test::agrees(squared_bias, bias * bias / kUnit, kReferenceMean)) << bias;
    EXPECT_TRUE(test::agrees(squared_error, (bias * bias + kNoise * kNoise) / kUnit, 1e-5)) << bias;
    EXPECT_TRUE(test::agrees(mean_bias, bias / 2.0, kReferenceMean)) << bias;
  }
}

TEST(Accuracy, IntervalsHoldAsOftenAsTheySay) {
  constexpr double kBias = 0.05;
  int bias_held = 0, error_held = 0, mean_held = 0;
  constexpr int kRuns = 400;
  for (std::uint64_t i = 0; i < kRuns; ++i) {
    const Accuracy a = measure_accuracy(seeds(2.0f + float(kBias), i), noisy_reference(i));
    const auto held = [](const Estimate& e, double want) {
      return std::abs(e.value - want) <= e.error;
    };
    bias_held += held(a.squared_bias, kBias * kBias / 4.0);
    error_held += held(a.squared_error, (kBias * kBias + kNoise * kNoise) / 4.0);
    mean_held += held(a.mean_bias, kBias / 2.0);
  }
  // 0.95 less 4.5 standard errors of the share.
  const double least = kRuns * (0.95 - 4.5 * std::sqrt(0.95 * 0.05 / kRuns));
  EXPECT_GE(bias_held, least);
  EXPECT_GE(error_held, least);
  EXPECT_GE(mean_held, least);
}

TEST(Accuracy, NoiseOfAReferenceWithErrorLayersIsTakenOff) {
  test::RunningMean squared_bias;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Image reference = noisy(2.0f, kReferenceNoise, 10 * i + 1);
    Image with_errors{.width = kWidth,
                      .height = kHeight,
                      .channels = {"R", "G", "B", "stderr.R", "stderr.G", "stderr.B"}};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        for (std::size_t c = 0; c < 3; ++c) with_errors.pixels.push_back(reference.at(x, y, c));
        with_errors.pixels.insert(with_errors.pixels.end(), 3, kReferenceNoise);
      }
    squared_bias.add(
        measure_accuracy(seeds(2.0f, i), reference_of_picture(with_errors)).squared_bias.value);
    EXPECT_EQ(reference_of_picture(reference).variance.pixels.size(), 0u);
  }
  EXPECT_TRUE(test::agrees(squared_bias, 0.0));
}

TEST(Accuracy, RootsOfEstimatesBelowZeroBeginAtZero) {
  const RootInterval below = root({.value = -1.0, .error = 4.0});
  EXPECT_EQ(below.value, 0.0);
  EXPECT_EQ(below.low, 0.0);
  EXPECT_EQ(below.high, 2.0);
  const RootInterval above = root({.value = 2.5, .error = 1.5});
  EXPECT_EQ(above.low, 1.0);
  EXPECT_EQ(above.high, 2.0);
}

}  // namespace
}  // namespace brume
