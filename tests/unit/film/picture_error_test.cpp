// SPDX-License-Identifier: Apache-2.0
#include "film/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sampler.h"
#include "film/film.h"
#include "support/statistics.h"

namespace brume {
namespace {

/// A picture of independent uniform samples in [0, 1] over 0.5, error 1/sqrt(12 n) each.
void expose(Film& film, std::uint32_t samples, std::uint64_t seed) {
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x)
      for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler sampler(seed, y * film.width() + x, i, true);
        film.add(x, y, {.L = {sampler.next_1d(), sampler.next_1d(), sampler.next_1d()}});
      }
}

TEST(PictureError, IsTheRootMeanSquareErrorOverTheMean) {
  constexpr std::uint32_t kSamples = 8;
  Film film(200, 100);
  expose(film, kSamples, 1);
  const PictureError error = picture_error(film);
  EXPECT_NEAR(error.relative_rms, 1.0 / std::sqrt(12.0 * kSamples) / 0.5, 0.002);
  EXPECT_GT(error.upper_bound, error.relative_rms);
  EXPECT_LT(error.upper_bound, 1.02 * error.relative_rms);
}

TEST(PictureError, UpperBoundHoldsAsOftenAsItSays) {
  test::RunningMean held;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Film film(16, 8);
    expose(film, 4, seed);
    held.add(picture_error(film).upper_bound > 1.0 / std::sqrt(12.0 * 4) / 0.5 ? 1.0 : 0.0);
  }
  EXPECT_TRUE(test::agrees(held, 0.95, 0.01));
}

TEST(PictureError, IsUnknownWhileAPixelHasOneSample) {
  Film film(2, 1);
  film.add(0, 0, {.L = Rgb(1.0f)});
  film.add(0, 0, {.L = Rgb(1.0f)});
  film.add(1, 0, {.L = Rgb(1.0f)});
  EXPECT_EQ(picture_error(film).relative_rms, INFINITY);
  film.add(1, 0, {.L = Rgb(1.0f)});
  EXPECT_EQ(picture_error(film).relative_rms, 0.0);
}

}  // namespace
}  // namespace brume
