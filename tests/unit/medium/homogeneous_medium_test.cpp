// SPDX-License-Identifier: Apache-2.0
#include "medium/homogeneous_medium.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace brume {
namespace {

const Ray kRay{{0, 0, 0}, {0, 0, 1}};

TEST(HomogeneousMedium, TransmittanceIsBeerLambert) {
  const HomogeneousMedium medium(Rgb(0.5f, 0.0f, 2.0f), Rgb(0.5f), {});
  const Rgb T = medium.transmittance(1.5f);
  EXPECT_FLOAT_EQ(T.r, std::exp(-0.75f));
  EXPECT_EQ(T.g, 1.0f);
  EXPECT_FLOAT_EQ(T.b, std::exp(-3.0f));
  EXPECT_EQ(medium.transmittance(kInfinity), Rgb(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(medium.transmittance(0.0f), Rgb(1.0f));
}

TEST(HomogeneousMedium, LightScatteredStraightOnWasNotScattered) {
  const HomogeneousMedium medium(Rgb(1.0f, 2.0f, 3.0f), Rgb(1.0f, 0.5f, 0.0f), {.g = 1.0f});
  const Rgb T = medium.transmittance(2.0f);
  EXPECT_EQ(T.r, 1.0f);
  EXPECT_FLOAT_EQ(T.g, std::exp(-2.0f));
  EXPECT_FLOAT_EQ(T.b, std::exp(-6.0f));
  EXPECT_FALSE(medium.summary().scatters);
}

TEST(HomogeneousMedium, SampledDistancesHaveTheMeanFreePath) {
  const HomogeneousMedium medium(Rgb(0.25f, 0.0f, 4.0f), Rgb(1.0f), {});
  for (const int channel : {0, 2}) {
    Rng rng(7);
    test::RunningMean distance;
    for (int i = 0; i < 200000; ++i)
      distance.add(medium.sample_distance(channel, rng.next_float()));
    EXPECT_TRUE(test::agrees(distance, channel == 0 ? 4.0 : 0.25));
  }
  EXPECT_EQ(medium.sample_distance(1, 0.5f), kInfinity);
  EXPECT_EQ(medium.sample_distance(1, 0.0f), kInfinity);
  EXPECT_EQ(medium.sample_distance(0, 0.0f), 0.0f);
  EXPECT_TRUE(std::isfinite(medium.sample_distance(0, kOneMinusEpsilon)));
}

TEST(HomogeneousMedium, ProbabilityOfPassingIsTheFrequencyOfPassing) {
  const HomogeneousMedium medium(Rgb(0.3f, 1.0f, 3.0f), Rgb(1.0f), {});
  const Rgb p_channel(0.5f, 0.3f, 0.2f);
  Rng rng(9);
  test::RunningMean passed;
  for (int i = 0; i < 200000; ++i) {
    const float u = rng.next_float();
    const int channel = u < 0.5f ? 0 : u < 0.8f ? 1 : 2;
    passed.add(medium.sample_distance(channel, rng.next_float()) > 0.7f);
  }
  EXPECT_TRUE(test::agrees(passed, medium.probability_of_passing(0.7f, p_channel)));
}

struct Case {
  Rgb sigma_t, albedo, beta;
  float t_max;
};

class HomogeneousFlight : public ::testing::TestWithParam<Case> {};

TEST_P(HomogeneousFlight, WeightsAreUnbiasedInEveryChannel) {
  const Case c = GetParam();
  const HomogeneousMedium medium(c.sigma_t, c.albedo, {});
  test::RunningMean scattered[3], passed[3], near_half[3];
  const float half = std::isfinite(c.t_max) ? 0.5f * c.t_max : 1.0f / c.sigma_t.r;
  for (int i = 0; i < 400000; ++i) {
    Sampler sampler(11, 0, i, true);
    const FreeFlight flight = medium.sample_free_flight(kRay, c.t_max, c.beta, sampler);
    const float total = c.beta.r + c.beta.g + c.beta.b;
    for (int k = 0; k < 3; ++k) {
      ASSERT_LE(c.beta[k] * flight.weight[k], total * 1.00001f);
      scattered[k].add(flight.scattered ? flight.weight[k] : 0.0f);
      near_half[k].add(flight.scattered && flight.t < half ? flight.weight[k] : 0.0f);
      passed[k].add(flight.scattered ? 0.0f : flight.weight[k]);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const double T = c.sigma_t[k] > 0.0f ? std::exp(-double(c.sigma_t[k]) * c.t_max) : 1.0;
    const double T_half = std::exp(-double(c.sigma_t[k]) * half);
    EXPECT_TRUE(test::agrees(scattered[k], c.albedo[k] * (1.0 - T), 1e-6));
    EXPECT_TRUE(test::agrees(near_half[k], c.albedo[k] * (1.0 - T_half), 1e-6));
    EXPECT_TRUE(test::agrees(passed[k], T, 1e-6));
  }
}

TEST_P(HomogeneousFlight, ThatIsKnownToScatterBringsTheSameLight) {
  const Case c = GetParam();
  const HomogeneousMedium medium(c.sigma_t, c.albedo, {});
  const float p_scatter = *medium.probability_of_scattering(kRay, c.t_max, c.beta);
  const float half = std::isfinite(c.t_max) ? 0.5f * c.t_max : 1.0f / c.sigma_t.r;
  test::RunningMean scatters, scattered[3], near_half[3];
  for (int i = 0; i < 400000; ++i) {
    Sampler sampler(13, 0, i, true), other(14, 0, i, true);
    scatters.add(medium.sample_free_flight(kRay, c.t_max, c.beta, other).scattered);
    const FreeFlight flight = medium.sample_scattering(kRay, c.t_max, c.beta, sampler);
    ASSERT_TRUE(flight.scattered);
    ASSERT_LE(flight.t, c.t_max);
    for (int k = 0; k < 3; ++k) {
      scattered[k].add(p_scatter * flight.weight[k]);
      near_half[k].add(flight.t < half ? p_scatter * flight.weight[k] : 0.0f);
    }
  }
  EXPECT_TRUE(test::agrees(scatters, p_scatter));
  for (int k = 0; k < 3; ++k) {
    const double T = c.sigma_t[k] > 0.0f ? std::exp(-double(c.sigma_t[k]) * c.t_max) : 1.0;
    const double T_half = std::exp(-double(c.sigma_t[k]) * half);
    EXPECT_TRUE(test::agrees(scattered[k], c.albedo[k] * (1.0 - T), 1e-6));
    EXPECT_TRUE(test::agrees(near_half[k], c.albedo[k] * (1.0 - T_half), 1e-6));
  }
}

TEST(HomogeneousMedium, ThinMediaHaveAnExactProbabilityOfScattering) {
  const HomogeneousMedium medium(Rgb(1e-12f), Rgb(0.5f), {});
  EXPECT_FLOAT_EQ(*medium.probability_of_scattering(kRay, 2.0f, Rgb(1.0f)), 2e-12f);
  Sampler sampler(1, 0, 0);
  const FreeFlight flight = medium.sample_scattering(kRay, 2.0f, Rgb(1.0f), sampler);
  EXPECT_TRUE(0.0f <= flight.t && flight.t <= 2.0f) << flight.t;
  EXPECT_NEAR(flight.weight.g, 0.5f, 1e-6f);
}

INSTANTIATE_TEST_SUITE_P(
    Coefficients, HomogeneousFlight,
    ::testing::Values(Case{Rgb(1.0f), Rgb(0.9f), Rgb(1.0f), 2.0f},
                      Case{Rgb(0.5f, 1.0f, 4.0f), Rgb(1.0f, 0.5f, 0.1f), Rgb(1.0f), 1.0f},
                      Case{Rgb(0.5f, 1.0f, 4.0f), Rgb(1.0f, 0.0f, 1.0f), Rgb(0.2f, 1.0f, 0.1f),
                           1.0f},
                      Case{Rgb(1.0f, 0.0f, 2.0f), Rgb(0.5f), Rgb(1.0f), 1.0f},
                      Case{Rgb(1.0f, 0.5f, 2.0f), Rgb(0.5f), Rgb(1.0f), kInfinity}));

TEST(HomogeneousMedium, ThatDoesNotScatterSamplesNothing) {
  const HomogeneousMedium medium(Rgb(1.0f, 2.0f, 3.0f), Rgb(0.0f), {});
  Sampler sampler(1, 0, 0);
  const FreeFlight flight = medium.sample_free_flight(kRay, 2.0f, Rgb(1.0f), sampler);
  EXPECT_FALSE(flight.scattered);
  EXPECT_EQ(flight.weight, medium.transmittance(2.0f));
  EXPECT_EQ(medium.probability_of_scattering(kRay, 2.0f, Rgb(1.0f)), 0.0f);
}

}  // namespace
}  // namespace brume
