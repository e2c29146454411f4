// SPDX-License-Identifier: Apache-2.0
#include "core/distribution.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/rng.h"

namespace brume {
namespace {

/// Weights whose intervals differ by ten orders of magnitude, with gaps.
std::vector<float> uneven_weights() {
  std::vector<float> weights = {0.0f, 3.0f, 0.0f, 0.0f, 1e-6f, 1e4f, 0.0f, 20.0f};
  for (int i = 0; i < 1000; ++i) weights.push_back(float(i % 7) * 0.01f);
  weights.push_back(0.0f);
  return weights;
}

TEST(Distribution1d, SamplesInvertTheCdf) {
  const std::vector<float> weights = uneven_weights();
  const Distribution1d distribution(weights);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  Rng rng(1);
  for (int i = 0; i < 100000; ++i) {
    const float u = i == 0 ? 0.0f : i == 1 ? kOneMinusEpsilon : rng.next_float();
    const Distribution1d::Sample s = distribution.sample(u);
    ASSERT_GT(weights[s.index], 0.0f);
    const double below =
        std::accumulate(weights.begin(), weights.begin() + std::ptrdiff_t(s.index), 0.0);
    ASSERT_NEAR((below + double(s.offset) * double(weights[s.index])) / total, double(u), 1e-7);
    ASSERT_EQ(std::size_t(s.x * float(distribution.size())), s.index);
    ASSERT_FLOAT_EQ(s.pdf, distribution.pdf(s.x));
  }
}

TEST(Distribution1d, WithoutWeightIsUniform) {
  const Distribution1d distribution(std::vector<float>(5, 0.0f));
  for (const float u : {0.0f, 0.3f, 0.99f}) {
    EXPECT_NEAR(distribution.sample(u).x, u, 1e-6f);
    EXPECT_FLOAT_EQ(distribution.pdf(u), 1.0f);
  }
}

}  // namespace
}  // namespace brume
