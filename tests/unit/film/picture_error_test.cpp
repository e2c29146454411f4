// SPDX-License-Identifier: Apache-2.0
#include "film/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

#include "core/sampler.h"
#include "film/film.h"
#include "support/statistics.h"

namespace brume {
namespace {

/// A grey sample of the pixel at `position` in [0, 1]^2.
using Draw = std::function<float(const Vec2& position, Sampler& sampler)>;

void expose(Film& film, std::uint32_t samples, std::uint64_t seed, const Draw& draw,
            bool independent = true) {
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x)
      for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler sampler(seed, y * film.width() + x, i, independent);
        const Vec2 position = Vec2(float(x), float(y)) / Vec2(film.width(), film.height());
        film.add(x, y, {.L = Rgb(draw(position, sampler))});
      }
}

float uniform(const Vec2& /*position*/, Sampler& sampler) {
  return sampler.next_1d();
}

TEST(PictureError, IsTheRootMeanSquareErrorOverTheMean) {
  constexpr std::uint32_t kSamples = 8;
  Film film(200, 100);
  expose(film, kSamples, 1, uniform);
  const PictureError error = picture_error(film);
  EXPECT_NEAR(error.relative_rms, 1.0 / std::sqrt(12.0 * kSamples) / 0.5, 0.002);
  EXPECT_GT(error.upper_bound, error.relative_rms);
  EXPECT_LT(error.upper_bound, 1.02 * error.relative_rms);
}

struct NoiseCase {
  const char* name;
  Draw draw;
  double mean;            // of a sample, where it is the same for all pixels
  std::uint32_t samples;  // a pixel
  double least_share;     // of pictures whose error the bound holds
  friend std::ostream& operator<<(std::ostream& out, const NoiseCase& c) { return out << c.name; }
};

class PictureErrorBound : public ::testing::TestWithParam<NoiseCase> {};

TEST_P(PictureErrorBound, HoldsTheErrorThatThePictureHas) {
  const NoiseCase& noise = GetParam();
  test::RunningMean held, ratio;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Film film(32, 24);
    expose(film, noise.samples, seed, noise.draw, false);
    double squares = 0.0;
    for (std::uint32_t y = 0; y < film.height(); ++y)
      for (std::uint32_t x = 0; x < film.width(); ++x)
        squares += std::pow(film.mean(x, y).r - noise.mean, 2.0);
    const double truth = relative_rmse(squares / (32.0 * 24.0), noise.mean);
    const PictureError error = picture_error(film);
    held.add(truth < error.upper_bound ? 1.0 : 0.0);
    ratio.add(truth / error.upper_bound);
  }
  EXPECT_GE(held.mean(), noise.least_share) << "true error over bound " << ratio.mean();
}

INSTANTIATE_TEST_SUITE_P(
    Noise, PictureErrorBound,
    ::testing::Values(
        NoiseCase{"even", uniform, 0.5, 64, 0.95},
        NoiseCase{"exponential",
                  [](const Vec2&, Sampler& sampler) { return -std::log1p(-sampler.next_1d()); },
                  1.0, 16, 0.95},
        NoiseCase{"uneven",
                  [](const Vec2& p, Sampler& sampler) {
                    return 1.0f + 2.0f * p.x * p.x * p.x * (sampler.next_1d() - 0.5f);
                  },
                  1.0, 64, 0.95},
        // One in forty pixels is hit: most are black and look finished.
        NoiseCase{"rare_light",
                  [](const Vec2&, Sampler& sampler) {
                    return sampler.rng().next_float() < 1.0f / 2560.0f ? 2560.0f : 0.0f;
                  },
                  1.0, 64, 0.95},
        // Three bright samples a picture.
        NoiseCase{"fireflies",
                  [](const Vec2&, Sampler& sampler) {
                    const float p = 3.0f / (32.0f * 24.0f * 64.0f);
                    return sampler.next_1d() + (sampler.rng().next_float() < p ? 0.1f / p : 0.0f);
                  },
                  0.6, 64, 0.9}),
    [](const auto& test) { return test.param.name; });

TEST(PictureError, IsUnknownWhileAPixelHasOneSample) {
  Film film(2, 1);
  film.add(0, 0, {.L = Rgb(1.0f)});
  film.add(0, 0, {.L = Rgb(1.0f)});
  film.add(1, 0, {.L = Rgb(1.0f)});
  EXPECT_EQ(picture_error(film).relative_rms, INFINITY);
  film.add(1, 0, {.L = Rgb(1.0f)});
  EXPECT_EQ(picture_error(film).relative_rms, 0.0);
}

TEST(PictureError, IsUnknownWhileThePictureIsBlack) {
  Film film(2, 1);
  for (int i = 0; i < 100; ++i)
    for (const std::uint32_t x : {0u, 1u}) film.add(x, 0, {});
  EXPECT_EQ(picture_error(film).relative_rms, INFINITY);
  EXPECT_EQ(picture_error(film).upper_bound, INFINITY);
}

TEST(PictureError, LeavesOutPixelsThatHaveNoGoodSample) {
  Film film(2, 1);
  for (int i = 0; i < 64; ++i) {
    film.add(0, 0, {.L = Rgb(float(i / 16 % 2))});
    film.add(1, 0, {.L = Rgb(std::nanf(""))});
  }
  EXPECT_GT(picture_error(film).relative_rms, 0.0);
  EXPECT_LT(picture_error(film).relative_rms, 1.0);
}

}  // namespace
}  // namespace brume
