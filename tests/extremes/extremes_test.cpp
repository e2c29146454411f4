// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "cell.h"
#include "size_scene.h"

namespace brume::test {
namespace {

class Extreme : public ::testing::TestWithParam<Cell> {};

TEST_P(Extreme, IsSoundAndRight) {
  const Cell& cell = GetParam();
  const Outcome got = measure(cell, cell.scene, cell.blocks);
  EXPECT_EQ(got.bad_samples, 0);
  EXPECT_EQ(got.violations, 0u);
  Outcome like;
  if (!cell.like.empty()) like = measure(cell, cell.like, cell.blocks);
  for (int c = 0; c < 3; ++c) {
    if (cell.want) {
      EXPECT_TRUE(agrees(got.L[c], (*cell.want)[c], cell.rounding * (*cell.want)[c] + kFaintest));
    }
    if (!cell.like.empty()) {
      EXPECT_TRUE(agree(got.L[c], like.L[c], cell.rounding * like.L[c].mean()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Matrix, Extreme, ::testing::ValuesIn(all_cells()),
                         [](const auto& cell) { return cell.param.name; });

/// Scaling by a power of two only moves exponents, so nothing may change but by a length that is
/// written into the program.
TEST(ExtremeSizes, PowersOfTwoGiveTheSameBits) {
  const Cell cell{};
  const Outcome one = measure(cell, size_scene(1.0, {0, 0, 0}), 32);
  for (const int exponent : {-50, -20, 20, 50}) {
    const Outcome other = measure(cell, size_scene(std::ldexp(1.0, exponent), {0, 0, 0}), 32);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(other.L[c].mean(), one.L[c].mean()) << "2^" << exponent;
  }
}

}  // namespace
}  // namespace brume::test
