// SPDX-License-Identifier: Apache-2.0
#include "study/same_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/develop.h"
#include "film/film.h"
#include "support/statistics.h"
#include "unit/study/pictures.h"

namespace brume {
namespace {

constexpr int kWidth = 40, kHeight = 30;

/// Radiance of one sample of a pixel whose mean is 1.
using Draw = float (*)(Rng& rng);

float exponential(Rng& rng) {
  return -std::log1p(-rng.next_float());
}
/// One sample in fifty carries half of the light.
float with_fireflies(Rng& rng) {
  const float firefly = rng.next_float() < 0.02f ? 25.0f : 0.0f;
  return 0.5f * exponential(rng) + firefly;
}

/// A rendered picture; samples of the pixels with `x < kWidth / 5` are scaled by `left`.
Image expose(Draw draw, std::uint32_t samples, std::uint64_t seed, float left = 1.0f) {
  Film film(kWidth, kHeight);
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      Rng rng(seed, y * kWidth + x);
      const float scale = x < kWidth / 5 ? left : 1.0f;
      for (std::uint32_t i = 0; i < samples; ++i)
        film.add(x, y, {.L = scale * Rgb(draw(rng), draw(rng), draw(rng))});
    }
  return develop(film);
}

double p_of(const Image& a, const Image& b) {
  return test_same_picture(Picture(a), Picture(b)).p_same;
}

/// Share of pairs of independent renders whose p lies below 0.05.
double false_alarms(Draw draw, std::uint32_t samples) {
  constexpr int kPairs = 200;
  int alarms = 0;
  for (int i = 0; i < kPairs; ++i)
    alarms += p_of(expose(draw, samples, 2 * i), expose(draw, samples, 2 * i + 1)) < 0.05;
  return double(alarms) / kPairs;
}

// 4.5 standard errors of a share of 0.05 over 200 pairs are 0.069.
TEST(SamePicture, RaisesNoMoreAlarmsThanItSays) {
  EXPECT_LE(false_alarms(exponential, 16), 0.05 + 0.069);
  EXPECT_LE(false_alarms(exponential, 64), 0.05 + 0.069);
}

TEST(SamePicture, FirefliesRaiseNoAlarms) {
  EXPECT_LE(false_alarms(with_fireflies, 16), 0.05 + 0.069);
}

TEST(SamePicture, AgainstAnExactReferenceToo) {
  const Image exact = test::picture(kWidth, kHeight, [](int, int) { return Rgb(1.0f); });
  int alarms = 0;
  for (int i = 0; i < 200; ++i) alarms += p_of(expose(exponential, 64, i), exact) < 0.05;
  EXPECT_LE(alarms / 200.0, 0.05 + 0.069);
}

TEST(SamePicture, FindsWhatDiffersInAPartOfThePicture) {
  // Standard error of a pixel 1/8; of the fifth that differs, 240 pixels, 0.8% of it.
  EXPECT_LT(p_of(expose(exponential, 64, 1), expose(exponential, 64, 2, 1.15f)), 1e-4);
  EXPECT_LT(p_of(expose(exponential, 64, 3), expose(exponential, 64, 4, 0.85f)), 1e-4);
}

TEST(SamePicture, MeanSquareOfWellKnownErrorsIsOne) {
  const Image a = expose(exponential, 1024, 5), b = expose(exponential, 1024, 6);
  const SamePicture same = test_same_picture(Picture(a), Picture(b));
  EXPECT_EQ(same.compared, std::uint64_t(kWidth) * kHeight * 3);
  // Student's t with twice 63 degrees has a mean square of 1.016 and a fourth moment near 3.
  EXPECT_NEAR(same.mean_square_z, 126.0 / 124.0, 4.5 * std::sqrt(2.1 / double(same.compared)));
  EXPECT_LT(same.share_beyond_3, 0.006);
}

TEST(SamePicture, ExactPicturesThatDifferAreNotTheSame) {
  Image a = expose([](Rng&) { return 1.0f; }, 16, 1);
  const Image b = a;
  EXPECT_EQ(p_of(a, b), 1.0);
  a.at(3, 4, 1) += 0.01f;
  const SamePicture same = test_same_picture(Picture(a), Picture(b));
  EXPECT_EQ(same.impossible, 1u);
  EXPECT_EQ(same.p_same, 0.0);
}

TEST(SamePicture, UnknownErrorsAreLeftOut) {
  const Image one_sample = expose(exponential, 1, 1);
  const SamePicture same = test_same_picture(Picture(one_sample), Picture(one_sample));
  EXPECT_EQ(same.compared, 0u);
  EXPECT_EQ(same.unknown, std::uint64_t(kWidth) * kHeight * 3);
  EXPECT_EQ(same.p_same, 1.0);
}

}  // namespace
}  // namespace brume
