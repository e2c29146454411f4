// SPDX-License-Identifier: Apache-2.0
#include "material/texture.h"

#include <gtest/gtest.h>

#include <memory>

#include "material/bitmap_texture.h"
#include "material/checkerboard_texture.h"

namespace brume {
namespace {

using Filter = BitmapTexture::Filter;
using Wrap = BitmapTexture::Wrap;

const Rgb kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kWhite{1, 1, 1};

/// Red, green; blue, white.
BitmapTexture two_by_two(Filter filter, Wrap wrap, const glm::mat3& to_uv = glm::mat3(1.0f)) {
  return {{kRed, kGreen, kBlue, kWhite}, 2, 2, filter, wrap, to_uv};
}

void expect_near(const Rgb& got, const Rgb& want) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], want[c], 1e-5f);
}

TEST(BitmapTexture, FirstRowLiesAtVZero) {
  const BitmapTexture image = two_by_two(Filter::kNearest, Wrap::kRepeat);
  EXPECT_EQ(image.value({0.0f, 0.0f}), kRed);
  EXPECT_EQ(image.value({0.99f, 0.01f}), kGreen);
  EXPECT_EQ(image.value({0.01f, 0.99f}), kBlue);
  EXPECT_EQ(image.value({0.99f, 0.99f}), kWhite);
}

TEST(BitmapTexture, BilinearIsExactAtPixelCentresAndMeansBetween) {
  const BitmapTexture image = two_by_two(Filter::kBilinear, Wrap::kClamp);
  expect_near(image.value({0.25f, 0.25f}), kRed);
  expect_near(image.value({0.75f, 0.75f}), kWhite);
  expect_near(image.value({0.5f, 0.25f}), 0.5f * (kRed + kGreen));
  expect_near(image.value({0.5f, 0.5f}), 0.25f * (kRed + kGreen + kBlue + kWhite));
  expect_near(image.value({0.25f, 0.375f}), 0.75f * kRed + 0.25f * kBlue);
}

TEST(BitmapTexture, CornersMixWhatTheWrapModePutsBeyondThem) {
  expect_near(two_by_two(Filter::kBilinear, Wrap::kClamp).value({0.0f, 0.0f}), kRed);
  expect_near(two_by_two(Filter::kBilinear, Wrap::kMirror).value({0.0f, 0.0f}), kRed);
  expect_near(two_by_two(Filter::kBilinear, Wrap::kRepeat).value({0.0f, 0.0f}),
              0.25f * (kRed + kGreen + kBlue + kWhite));
  expect_near(two_by_two(Filter::kBilinear, Wrap::kClamp).value({1.0f, 1.0f}), kWhite);
  expect_near(two_by_two(Filter::kBilinear, Wrap::kMirror).value({1.0f, 1.0f}), kWhite);
}

TEST(BitmapTexture, WrapModesContinueTheImageOutside) {
  for (const Filter filter : {Filter::kNearest, Filter::kBilinear}) {
    const BitmapTexture repeat = two_by_two(filter, Wrap::kRepeat);
    expect_near(repeat.value({1.25f, -0.75f}), kRed);
    expect_near(repeat.value({-0.25f, 3.25f}), kGreen);
    expect_near(repeat.value({-7.75f, 5.75f}), kBlue);
    const BitmapTexture mirror = two_by_two(filter, Wrap::kMirror);
    expect_near(mirror.value({-0.25f, 0.25f}), kRed);
    expect_near(mirror.value({1.25f, 0.25f}), kGreen);
    expect_near(mirror.value({1.75f, 0.25f}), kRed);
    expect_near(mirror.value({-1.25f, -0.75f}), kWhite);
    const BitmapTexture clamp = two_by_two(filter, Wrap::kClamp);
    expect_near(clamp.value({-3.0f, 0.25f}), kRed);
    expect_near(clamp.value({1e20f, 0.25f}), kGreen);
    expect_near(clamp.value({0.25f, 7.0f}), kBlue);
  }
}

TEST(BitmapTexture, TransformIsAppliedToCoordinates) {
  glm::mat3 flip(1.0f);  // v -> 1 - v
  flip[1][1] = -1.0f;
  flip[2][1] = 1.0f;
  EXPECT_EQ(two_by_two(Filter::kNearest, Wrap::kRepeat, flip).value({0.25f, 0.25f}), kBlue);
  glm::mat3 scale(1.0f);  // four times as many
  scale[0][0] = scale[1][1] = 4.0f;
  const BitmapTexture small = two_by_two(Filter::kNearest, Wrap::kRepeat, scale);
  EXPECT_EQ(small.value({0.2f, 0.01f}), kGreen);
  EXPECT_EQ(small.value({0.26f, 0.01f}), kRed);
}

TEST(BitmapTexture, OnePixelIsThatColourEverywhere) {
  for (const Wrap wrap : {Wrap::kRepeat, Wrap::kMirror, Wrap::kClamp}) {
    const BitmapTexture image({kGreen}, 1, 1, Filter::kBilinear, wrap, glm::mat3(1.0f));
    for (const float x : {-3.3f, -1e-9f, 0.0f, 0.5f, 1.0f, 12.7f}) {
      expect_near(image.value({x, -x}), kGreen);
    }
  }
}

TEST(CheckerboardTexture, AlternatesByHalvesAndFollowsItsTransform) {
  const auto red = std::make_shared<ConstantTexture>(kRed);
  const auto blue = std::make_shared<ConstantTexture>(kBlue);
  const CheckerboardTexture board(red, blue, glm::mat3(1.0f));
  EXPECT_EQ(board.value({0.25f, 0.25f}), kRed);
  EXPECT_EQ(board.value({0.75f, 0.25f}), kBlue);
  EXPECT_EQ(board.value({0.25f, 0.75f}), kBlue);
  EXPECT_EQ(board.value({0.75f, 0.75f}), kRed);
  EXPECT_EQ(board.value({-0.25f, 1.25f}), kBlue);
  glm::mat3 shift(1.0f);
  shift[2][0] = 0.5f;
  EXPECT_EQ(CheckerboardTexture(red, blue, shift).value({0.25f, 0.25f}), kBlue);
}

}  // namespace
}  // namespace brume
