// SPDX-License-Identifier: Apache-2.0
#include "phase/henyey_greenstein.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.h"
#include "support/chi_square.h"
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

// 2 pi int p sin theta d theta = 1, theta from the peak, whose width 1 - |g| may be a millionth:
// the logarithm of theta is stepped through.
TEST_P(HenyeyGreensteinLaw, IntegratesToOne) {
  const HenyeyGreenstein phase{GetParam()};
  if (phase.is_delta()) return;
  const double peak = GetParam() < 0.0f ? -1.0 : 1.0;
  const double first = std::log(1e-9), last = std::log(M_PI);
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = std::exp(first + (i + 0.5) / kSteps * (last - first));
    const Vec3 d_out(peak * std::sin(theta), 0.0, peak * std::cos(theta));
    sum += theta * std::sin(theta) * double(phase.eval({0, 0, 1}, d_out));
  }
  EXPECT_NEAR(2.0 * M_PI * sum * (last - first) / kSteps, 1.0, 1e-5);
}

/// Share of the light that is scattered farther from the peak than a direction: the CDF of cos
/// theta for g = |a|, rearranged so that it holds at a = 0 and for a -> 1 as well. `from_peak` and
/// `to_peak` are 1 - cos theta and 1 + cos theta.
double share_beyond(double a, double from_peak, double to_peak) {
  const double D = std::sqrt((1.0 - a) * (1.0 - a) + 2.0 * a * from_peak);
  return (1.0 - a) * to_peak / (D * (1.0 + a + D));
}

TEST_P(HenyeyGreensteinLaw, SamplesFollowTheCumulativeDistribution) {
  const HenyeyGreenstein phase{GetParam()};
  if (phase.is_delta()) return;
  constexpr int kShares = 100, kAzimuths = 8, kSamples = 200000;
  std::array<double, kShares * kAzimuths> observed{};
  const glm::dvec3 d(0.0, 0.0, 1.0), peak = GetParam() < 0.0f ? -d : d;
  Rng rng(3);
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec3 d_out(phase.sample(Vec3(d), rng.next_vec2()).d);
    const glm::dvec3 away = d_out - peak, toward = d_out + peak;
    const double share = share_beyond(std::abs(double(GetParam())), 0.5 * glm::dot(away, away),
                                      0.5 * glm::dot(toward, toward));
    const double turn = std::atan2(d_out.y, d_out.x) / (2.0 * M_PI) + 0.5;
    const int row = std::clamp(int(share * kShares), 0, kShares - 1);
    const int column = std::clamp(int(turn * kAzimuths), 0, kAzimuths - 1);
    ++observed[std::size_t(row * kAzimuths + column)];
  }
  const double expected = double(kSamples) / double(observed.size());
  double chi_square = 0.0;
  for (const double o : observed) chi_square += (o - expected) * (o - expected) / expected;
  EXPECT_GT(test::upper_gamma(0.5 * double(observed.size() - 1), 0.5 * chi_square), 1e-5)
      << "chi-square " << chi_square;
}

INSTANTIATE_TEST_SUITE_P(Asymmetries, HenyeyGreensteinLaw,
                         ::testing::Values(-1.0f, -0.999999f, -0.9f, -1e-4f, -1e-8f, 0.0f, 1e-8f,
                                           1e-4f, 0.5f, 0.9f, 0.999999f, 1.0f));

}  // namespace
}  // namespace brume
