// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <thread>
#include <vector>

#include "core/sampler.h"
#include "support/statistics.h"

namespace brume {
namespace {

CameraSample grey(float L) {
  return {.L = Rgb(L), .alpha = 0.5f};
}

/// Value of a sample of pixel (trial, 0) of a picture one pixel high.
using Draw = std::function<float(std::uint32_t trial, std::uint32_t sample)>;

float exponential(std::uint32_t trial, std::uint32_t sample) {
  return -std::log1p(-Sampler(3, trial, sample, true).next_1d());
}

/// Smooth in two dimensions, so that stratification makes samples of a replication compensate.
float smooth(std::uint32_t trial, std::uint32_t sample) {
  const Vec2 u = Sampler(4, trial, sample).next_2d();
  return 1.0f + u.x * u.y + u.x;
}

struct SpreadCase {
  const char* name;
  Draw draw;
  std::uint32_t samples;

  friend std::ostream& operator<<(std::ostream& out, const SpreadCase& c) { return out << c.name; }
};

class FilmSpread : public ::testing::TestWithParam<SpreadCase> {};

TEST_P(FilmSpread, SquaredStandardErrorIsOnAverageTheVarianceOfTheMean) {
  constexpr std::uint32_t kTrials = 20000;
  const auto& [name, draw, samples] = GetParam();
  Film film(kTrials, 1);
  test::RunningMean mean;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    for (std::uint32_t sample = 0; sample < samples; ++sample)
      film.add(trial, 0, grey(draw(trial, sample)));
    mean.add(film.mean(trial, 0).r);
  }
  test::RunningMean estimated, actual;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const double error = film.standard_error(trial, 0).r;
    const double deviation = film.mean(trial, 0).r - mean.mean();
    estimated.add(error * error);
    actual.add(deviation * deviation * kTrials / (kTrials - 1.0));
  }
  EXPECT_TRUE(test::agree(estimated, actual));
}

INSTANTIATE_TEST_SUITE_P(Samples, FilmSpread,
                         ::testing::Values(SpreadCase{"independent_single", exponential, 7},
                                           SpreadCase{"independent_whole", exponential, 64},
                                           SpreadCase{"independent_partial", exponential, 69},
                                           SpreadCase{"independent_many", exponential, 700},
                                           SpreadCase{"stratified_whole", smooth, 512},
                                           SpreadCase{"stratified_many", smooth, 704}),
                         [](const auto& test) { return test.param.name; });

/// Share of trials whose mean lies within 1.96 standard errors of `truth`.
test::RunningMean coverage(const Draw& draw, double truth, std::uint32_t samples) {
  constexpr std::uint32_t kTrials = 10000;
  Film film(kTrials, 1);
  test::RunningMean covered;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    for (std::uint32_t sample = 0; sample < samples; ++sample)
      film.add(trial, 0, grey(draw(trial, sample)));
    const double z = (film.mean(trial, 0).r - truth) / film.standard_error(trial, 0).r;
    covered.add(std::abs(z) < 1.96 ? 1.0 : 0.0);
  }
  return covered;
}

TEST(Film, StandardErrorCoversTheTruthAsOftenAsItSays) {
  // The means of 32 replications: a z-value follows Student's t with 31 degrees of freedom, which
  // lies within 1.96 in 94.1% of cases.
  EXPECT_TRUE(test::agrees(coverage(smooth, 1.75, 2048), 0.941, 0.003));
}

TEST(Film, PartsOfAReplicationNeverMakeTheErrorLookTooSmall) {
  // Few of a replication's samples are worse than their share of it, and must be taken for that.
  const test::RunningMean whole = coverage(smooth, 1.75, 512);
  for (const std::uint32_t partial : {16, 72, 128, 448, 520, 552}) {
    const test::RunningMean covered = coverage(smooth, 1.75, partial);
    EXPECT_GT(covered.mean(), whole.mean() - test::kMaxZ * whole.standard_error()) << partial;
  }
}

TEST(Film, MeanCountsEverySampleOnce) {
  Film film(2, 2);
  for (int i = 1; i <= 21; ++i)
    film.add(1, 0, {.L = {float(i), 2.0f * float(i), 0.0f}, .alpha = 1});
  EXPECT_EQ(film.samples(1, 0), 21u);
  EXPECT_EQ(film.mean(1, 0), Rgb(11.0f, 22.0f, 0.0f));
  EXPECT_EQ(film.alpha(1, 0), 1.0f);
  EXPECT_EQ(film.samples(0, 1), 0u);
  EXPECT_EQ(film.mean(0, 1), Rgb(0.0f));
}

TEST(Film, ErrorIsUnknownBelowTwoSamples) {
  Film film(1, 1);
  EXPECT_EQ(film.standard_error(0, 0), Rgb(kInfinity));
  film.add(0, 0, grey(1.0f));
  EXPECT_EQ(film.standard_error(0, 0), Rgb(kInfinity));
  film.add(0, 0, grey(3.0f));
  EXPECT_FLOAT_EQ(film.standard_error(0, 0).r, 1.0f);
}

TEST(Film, EqualSamplesHaveNoError) {
  Film film(1, 1);
  for (int i = 0; i < 100; ++i) film.add(0, 0, grey(0.1f));
  EXPECT_EQ(film.standard_error(0, 0), Rgb(0.0f));
}

TEST(Film, ErrorScalesWithRadianceOverSixtyDecades) {
  for (const float scale : {1e-30f, 1e30f}) {
    Film film(1, 1);
    for (int i = 0; i < 128; ++i) film.add(0, 0, grey(scale * float(1 + i % 2 * 2 + i / 16 % 2)));
    EXPECT_GT(film.standard_error(0, 0).r, 0.01f * scale);
    EXPECT_LT(film.standard_error(0, 0).r, scale);
  }
}

TEST(Film, BadSamplesAreCountedAndLeftOut) {
  const float nan = std::nanf("");
  const CameraSample bad[] = {{.L = {1.0f, nan, 1.0f}},
                              {.L = {kInfinity, 0.0f, 0.0f}},
                              {.L = {1.0f, 1.0f, -1e-3f}},
                              {.L = Rgb(1.0f), .alpha = nan},
                              {.L = Rgb(1.0f), .albedo = Rgb(nan)},
                              {.L = Rgb(1.0f), .depth = nan}};
  Film film(3, 2);
  EXPECT_FALSE(film.bad_samples());
  for (int i = 0; i < 200; ++i) film.add(2, 1, grey(2.0f));
  for (const CameraSample& sample : bad) film.add(2, 1, sample);
  film.add(1, 0, bad[0]);
  for (int i = 0; i < 200; ++i) film.add(2, 1, grey(2.0f));

  ASSERT_TRUE(film.bad_samples());
  EXPECT_EQ(film.bad_samples()->count, 7u);
  EXPECT_EQ(film.bad_samples()->x, 1u);
  EXPECT_EQ(film.bad_samples()->y, 0u);
  EXPECT_EQ(film.samples(2, 1), 400u);
  EXPECT_EQ(film.mean(2, 1), Rgb(2.0f));
  EXPECT_EQ(film.standard_error(2, 1), Rgb(0.0f));
  EXPECT_EQ(film.samples(1, 0), 0u);
}

TEST(Film, FirstBadPixelIsTheSmallestWhicheverThreadComesFirst) {
  Film film(64, 64);
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < 4; ++t)
    threads.emplace_back([&film, t] {
      for (std::uint32_t y = 64; y-- > 0;)
        for (std::uint32_t x = t; x < 64; x += 4)
          if (y * 64 + x >= 707) film.add(x, y, grey(-1.0f));
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(film.bad_samples()->count, 64u * 64u - 707u);
  EXPECT_EQ(film.bad_samples()->x, 707u % 64u);
  EXPECT_EQ(film.bad_samples()->y, 707u / 64u);
}

TEST(Film, DepthIsTheMeanOverSamplesThatMetSomething) {
  Film film(2, 1, {.albedo = true, .depth = true});
  film.add(0, 0, {.albedo = Rgb(0.9f, 0.6f, 0.0f), .depth = 2.0f});
  film.add(0, 0, {.albedo = Rgb(0.9f, 0.6f, 0.0f), .depth = 4.0f});
  film.add(0, 0, {});
  film.add(1, 0, {});
  EXPECT_EQ(film.depth(0, 0), 3.0f);
  EXPECT_FLOAT_EQ(film.albedo(0, 0).r, 0.6f);
  EXPECT_EQ(film.depth(1, 0), kInfinity);
  EXPECT_EQ(film.albedo(1, 0), Rgb(0.0f));
}

}  // namespace
}  // namespace brume
