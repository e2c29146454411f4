// SPDX-License-Identifier: Apache-2.0
#include "study/comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "unit/study/pictures.h"

namespace brume {
namespace {

Image flat(float value) {
  return test::picture(4, 5, [value](int, int) { return Rgb(value); });
}

TEST(Comparison, OfAPictureWithItselfIsZero) {
  const Comparison c = compare(flat(0.3f), flat(0.3f));
  EXPECT_EQ(c.rmse, 0.0);
  EXPECT_EQ(c.relative_rmse, 0.0);
  EXPECT_EQ(c.relative_mse, 0.0);
  EXPECT_EQ(c.psnr, INFINITY);
  EXPECT_TRUE(c.worst.empty());
  EXPECT_FALSE(c.same);
  EXPECT_FALSE(c.bias_error);
}

TEST(Comparison, FiguresOfTwoPixelsByHand) {
  const Image reference =
      test::picture(2, 1, [](int x, int) { return x == 0 ? Rgb(1, 2, 3) : Rgb(4, 4, 4); });
  const Image a =
      test::picture(2, 1, [](int x, int) { return x == 0 ? Rgb(1, 2, 3) : Rgb(4, 5, 2); });
  const Comparison c = compare(a, reference);
  EXPECT_EQ(c.mean, glm::dvec3(2.5, 3.5, 2.5));
  EXPECT_EQ(c.reference_mean, glm::dvec3(2.5, 3.0, 3.5));
  EXPECT_EQ(c.bias, glm::dvec3(0.0, 0.5, -1.0));
  const double mse = (1.0 + 4.0) / 6.0;
  EXPECT_DOUBLE_EQ(c.rmse, std::sqrt(mse));
  EXPECT_DOUBLE_EQ(c.relative_rmse, std::sqrt(mse) / 3.0);
  EXPECT_DOUBLE_EQ(c.epsilon, 0.03);
  EXPECT_DOUBLE_EQ(c.relative_mse, (1.0 + 4.0) / (16.0 + 0.03 * 0.03) / 6.0);
  EXPECT_DOUBLE_EQ(c.psnr, 10.0 * std::log10(16.0 / mse));
  ASSERT_EQ(c.worst.size(), 1u);
  EXPECT_EQ(c.worst[0].x, 1);
  EXPECT_EQ(c.worst[0].value, glm::dvec3(4, 5, 2));
}

TEST(Comparison, WorstPixelsComeFirstAndAreFive) {
  const Image a =
      test::picture(4, 5, [](int x, int y) { return Rgb(float((7 * (4 * y + x)) % 20)); });
  const Comparison c = compare(a, flat(0.0f));
  ASSERT_EQ(c.worst.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(c.worst[std::size_t(i)].value.r, 19.0 - i);
}

TEST(Comparison, BlackReferenceGivesNoNaN) {
  const Comparison c = compare(flat(1.0f), flat(0.0f));
  EXPECT_EQ(c.relative_rmse, INFINITY);
  EXPECT_EQ(c.relative_mse, INFINITY);
  EXPECT_EQ(c.psnr, -INFINITY);
  EXPECT_EQ(compare(flat(0.0f), flat(0.0f)).relative_rmse, 0.0);
}

TEST(Comparison, DifferentSizesAreRefused) {
  const Image other = test::picture(5, 4, [](int, int) { return Rgb(0.0f); });
  EXPECT_THROW(compare(flat(1.0f), other), Error);
}

}  // namespace
}  // namespace brume
