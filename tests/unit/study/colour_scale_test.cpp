// SPDX-License-Identifier: Apache-2.0
#include "study/colour_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/heat_map.h"
#include "unit/study/pictures.h"

namespace brume {
namespace {

/// CIE 1976 lightness.
double lightness(const Rgb& linear) {
  return 116.0 * std::cbrt(double(luminance(linear))) - 16.0;
}

TEST(ColourScale, LightnessAloneTellsTheOrder) {
  constexpr int kSteps = 50;
  const double range = lightness(scale_colour(1.0)) - lightness(scale_colour(0.0));
  EXPECT_GT(range, 75.0);
  for (int i = 0; i < kSteps; ++i) {
    const double step = lightness(scale_colour(double(i + 1) / kSteps)) -
                        lightness(scale_colour(double(i) / kSteps));
    EXPECT_GT(step, 0.7 * range / kSteps) << i;
    EXPECT_LT(step, 1.3 * range / kSteps) << i;
  }
}

TEST(HeatMap, EqualRatiosAreEquallyFarApart) {
  EXPECT_EQ(heat_position(0.0), 0.0);
  EXPECT_EQ(heat_position(1e-4), 0.0);
  EXPECT_NEAR(heat_position(0.01), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(heat_position(0.1), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(heat_position(1.0), 1.0);
  EXPECT_EQ(heat_position(7.0), 1.0);
  EXPECT_EQ(heat_position(INFINITY), 1.0);
}

TEST(HeatMap, ShowsEachPixelsErrorRelativeToItself) {
  const Image reference =
      test::picture(2, 1, [](int x, int) { return Rgb(x == 0 ? 1.0f : 10.0f); });
  const Image a = test::picture(2, 1, [](int x, int) { return Rgb(x == 0 ? 1.0f : 11.0f); });
  const Image map = heat_map(a, reference);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(map.at(0, 0, c), scale_colour(0.0)[int(c)]);
    EXPECT_NEAR(map.at(1, 0, c), scale_colour(2.0 / 3.0)[int(c)], 1e-4);
  }
}

TEST(HeatMap, LegendStandsUnderSmallAndLargeMaps) {
  for (const int width : {1, 64, 1000}) {
    const Image map = test::picture(width, 2, [](int, int) { return Rgb(0.25f); });
    const Image with = with_legend(map);
    EXPECT_GE(with.width, 240);
    EXPECT_EQ(with.width % width, 0);
    EXPECT_EQ(with.at(with.width - 1, 2 * with.width / width - 1, 0), 0.25f);
    int black = 0;
    for (int y = 2 * with.width / width; y < with.height; ++y)
      for (int x = 0; x < with.width; ++x) black += with.at(x, y, 0) == 0.0f;
    EXPECT_GT(black, 200);  // ticks and digits
  }
}

}  // namespace
}  // namespace brume
