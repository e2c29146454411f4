// SPDX-License-Identifier: Apache-2.0
#include "phase/henyey_greenstein.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "support/statistics.h"

namespace brume {
namespace {

class HenyeyGreensteinLaw : public ::testing::TestWithParam<float> {};

TEST_P(HenyeyGreensteinLaw, MeanCosineIsG) {
  const HenyeyGreenstein phase{GetParam()};
  const Vec3 d = glm::normalize(Vec3(0.3f, -0.5f, 0.8f));
  Rng rng(1);
  test::RunningMean cosine;
  for (int i = 0; i < 200000; ++i) cosine.add(glm::dot(d, phase.sample(d, rng.next_vec2()).d));
  EXPECT_TRUE(test::agrees(cosine, GetParam(), 1e-6));
}

TEST_P(HenyeyGreensteinLaw, SampledDensityIsTheEvaluatedOne) {
  const HenyeyGreenstein phase{GetParam()};
  if (phase.is_delta()) {
    EXPECT_EQ(phase.sample({0, 0, 1}, {0.3f, 0.4f}).d, Vec3(0, 0, GetParam()));
    EXPECT_EQ(phase.sample({0, 0, 1}, {0.3f, 0.4f}).pdf, kInfinity);
    EXPECT_EQ(phase.eval({0, 0, 1}, {0, 0, GetParam()}), 0.0f);
    return;
  }
  const Vec3 d = glm::normalize(Vec3(-0.2f, 0.9f, 0.1f));
  Rng rng(2);
  // Directions are unit to 1e-7, which moves 1 - cos near the peak by that much.
  const float width = 1.0f - std::abs(GetParam());
  const float tolerance = 1e-5f + 6e-7f / width;
  if (tolerance > 0.1f) return;
  for (int i = 0; i < 20000; ++i) {
    const PhaseSample s = phase.sample(d, rng.next_vec2());
    ASSERT_NEAR(length_squared(s.d), 1.0f, 1e-6f);
    ASSERT_NEAR(phase.eval(d, s.d) / s.pdf, 1.0f, tolerance) << "cos " << glm::dot(d, s.d);
  }
}

INSTANTIATE_TEST_SUITE_P(Asymmetries, HenyeyGreensteinLaw,
                         ::testing::Values(-1.0f, -0.999999f, -0.9f, -1e-4f, -1e-8f, 0.0f, 1e-8f,
                                           1e-4f, 0.5f, 0.9f, 0.999999f, 1.0f));

}  // namespace
}  // namespace brume
