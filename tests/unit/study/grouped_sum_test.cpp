// SPDX-License-Identifier: Apache-2.0
#include "study/grouped_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "study/comparison.h"
#include "support/statistics.h"
#include "unit/study/pictures.h"

namespace brume {
namespace {

constexpr int kWidth = 144, kHeight = 108;
constexpr int kPeriod = kLightPathSpacing;
// All groups have as many pixels.
static_assert(kWidth % kPeriod == 0 && kHeight % kPeriod == 0);

/// Mean 0, variance 1, symmetric.
using Draw = float (*)(Rng& rng);

float triangular(Rng& rng) {
  const float u = rng.next_float();
  return std::sqrt(6.0f) * (u + rng.next_float() - 1.0f);
}
/// Nothing but for one in fifty.
float rare(Rng& rng) {
  if (rng.next_float() >= 0.02f) return 0.0f;
  return rng.next_float() < 0.5f ? -std::sqrt(50.0f) : std::sqrt(50.0f);
}

/// Standard error of a pixel: honest, and not the same everywhere.
float error_of(int x) {
  return 0.5f + float(x) / kWidth;
}

/// How the errors of a picture come about.
struct Noise {
  Draw shared_draw = triangular;
  float shared = 0.1f;    // share of a pixel's variance that all pixels of its group have in common
  int spacing = kPeriod;  // [pixel] of a group's pixels; a multiple of kPeriod
};

/// A picture of radiance 0 with error layers, plus `bias(x, y)`.
template <typename Bias>
Image noisy(const Noise& noise, std::uint64_t seed, Bias bias) {
  Rng rng(seed);
  const int spacing = noise.spacing;
  std::vector<float> of_group(std::size_t(spacing * spacing * 3));
  for (float& e : of_group) e = std::sqrt(noise.shared) * noise.shared_draw(rng);
  const float own = std::sqrt(1.0f - noise.shared);

  Image image{.width = kWidth,
              .height = kHeight,
              .channels = {"R", "G", "B", "stderr.R", "stderr.G", "stderr.B"}};
  image.pixels.reserve(std::size_t(kWidth * kHeight * 6));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float error = error_of(x);
      const std::size_t group = std::size_t(y % spacing * spacing + x % spacing);
      for (std::size_t c = 0; c < 3; ++c)
        image.pixels.push_back(error * (of_group[3 * group + c] + own * triangular(rng)) +
                               bias(x, y));
      image.pixels.insert(image.pixels.end(), 3, error);
    }
  return image;
}
Image noisy(const Noise& noise, std::uint64_t seed) {
  return noisy(noise, seed, [](int, int) { return 0.0f; });
}

const Image& black() {
  static const Image image = test::picture(kWidth, kHeight, [](int, int) { return Rgb(0.0f); });
  return image;
}

/// Standard error of a picture's mean when a share `shared` of the variance is common to a group.
double true_error(double shared) {
  double squares = 0.0, group_errors[kPeriod] = {};
  for (int x = 0; x < kWidth; ++x) {
    squares += double(error_of(x)) * error_of(x) * kHeight;
    group_errors[x % kPeriod] += double(error_of(x)) * (kHeight / kPeriod);
  }
  double variance = (1.0 - shared) * squares;
  for (const double e : group_errors) variance += shared * e * e * kPeriod;
  return std::sqrt(variance) / (kWidth * kHeight);
}

constexpr int kTrials = 200;
// 4.5 standard errors of a share of 0.05.
constexpr double kMaxAlarms = 0.05 + 0.069;

double false_alarms(const Noise& noise) {
  int alarms = 0;
  for (int i = 0; i < kTrials; ++i)
    alarms +=
        test_same_picture(Picture(noisy(noise, std::uint64_t(i))), Picture(black())).p_same < 0.05;
  return double(alarms) / kTrials;
}

TEST(GroupedSum, SharedLightPathsRaiseNoAlarms) {
  EXPECT_LE(false_alarms({.shared = 0.1f}), kMaxAlarms);
  EXPECT_LE(false_alarms({.shared = 0.01f}), kMaxAlarms);
  EXPECT_LE(false_alarms({.spacing = 2 * kPeriod}), kMaxAlarms);
}

TEST(GroupedSum, SharedFirefliesRaiseNoAlarms) {
  EXPECT_LE(false_alarms({.shared_draw = rare}), kMaxAlarms);
}

TEST(GroupedSum, IndependentPixelsRaiseNoAlarms) {
  EXPECT_LE(false_alarms({.shared = 0.0f}), kMaxAlarms);
}

TEST(GroupedSum, ErrorOfTheBiasIsItsSpread) {
  // Pixels taken for independent would make it too small by a factor of four.
  ASSERT_GT(true_error(0.1), 4.0 * true_error(0.0));
  test::RunningMean squared_z, squared_error;
  for (int i = 0; i < kTrials; ++i) {
    const Comparison c = compare(noisy({}, std::uint64_t(i)), black());
    for (int channel = 0; channel < 3; ++channel) {
      const double error = (*c.bias_error)[channel];
      const double z = c.bias[channel] / error;
      squared_z.add(z * z);
      squared_error.add(error * error);
    }
  }
  EXPECT_TRUE(test::agrees(squared_z, 80.0 / 78.0));  // Student's t with 80 degrees
  EXPECT_TRUE(test::agrees(squared_error, true_error(0.1) * true_error(0.1)));
}

TEST(GroupedSum, ErrorOfTheBiasOfIndependentPixelsIsHardlyLarger) {
  test::RunningMean error;
  for (int i = 0; i < kTrials; ++i) {
    const Comparison c = compare(noisy({.shared = 0.0f}, std::uint64_t(i)), black());
    EXPECT_GE(c.bias_error->r, true_error(0.0) * (1.0 - 1e-6));
    error.add(c.bias_error->r);
  }
  EXPECT_LT(error.mean(), 1.05 * true_error(0.0));
}

TEST(GroupedSum, FindsASmallBiasEverywhere) {
  const auto bias = float(7.0 * true_error(0.1));
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Image a = noisy({}, seed, [bias](int, int) { return bias; });
    EXPECT_LT(test_same_picture(Picture(a), Picture(black())).p_same, 0.001) << seed;
    EXPECT_GT(compare(a, black()).bias_error->r, 0.7 * true_error(0.1));
    EXPECT_LT(compare(a, black()).bias_error->r, 1.4 * true_error(0.1));
  }
}

TEST(GroupedSum, FindsABiasInOneBlock) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Image a = noisy(
        {}, seed, [](int x, int y) { return x / 12 == 5 && y / 12 == 3 ? error_of(x) : 0.0f; });
    EXPECT_LT(test_same_picture(Picture(a), Picture(black())).p_same, 1e-4) << seed;
  }
}

// The spread of the groups takes a bias of few of them for noise; its bound does not.
TEST(GroupedSum, FindsABiasInAFewPixels) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Image a = noisy({}, seed, [](int x, int y) {
      return x / 3 == 20 && y / 3 == 12 ? 20.0f * error_of(x) : 0.0f;
    });
    EXPECT_LT(test_same_picture(Picture(a), Picture(black())).p_same, 1e-4) << seed;
  }
}

TEST(GroupedSum, OfSinglePixelsIsThatOfIndependentOnes) {
  GroupedSum sum;
  for (int y = 0; y < kPeriod; ++y)
    for (int x = 0; x < kPeriod; ++x) sum.add(x, y, x == 4 ? 100.0 : 0.0, 4.0);
  EXPECT_DOUBLE_EQ(sum.variance(), 4.0 * kPeriod * kPeriod);
}

TEST(GroupedSum, OfOneGroupErrsAtMostAsOne) {
  GroupedSum sum;
  sum.add(2, 5, 1.0, 4.0);
  sum.add(2 + kPeriod, 5, 1.0, 9.0);
  sum.add(2, 5 + 2 * kPeriod, 1.0, 1.0);
  EXPECT_DOUBLE_EQ(sum.variance(), (2.0 + 3.0 + 1.0) * (2.0 + 3.0 + 1.0));
  EXPECT_DOUBLE_EQ(sum.p(), 2.0 / M_PI * std::atan(6.0 / 3.0));  // Cauchy, beyond half an error
}

TEST(GroupedSum, KnowsWhatIsExactAndWhatIsUnknown) {
  GroupedSum exact;
  for (int x = 0; x < 20; ++x) exact.add(x, 0, double(x), 0.0);
  EXPECT_EQ(exact.variance(), 0.0);
  GroupedSum unknown = exact;
  unknown.add(20, 0, 0.0, INFINITY);
  EXPECT_EQ(unknown.variance(), INFINITY);
}

}  // namespace
}  // namespace brume
