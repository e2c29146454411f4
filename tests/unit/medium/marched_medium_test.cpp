// SPDX-License-Identifier: Apache-2.0
#include "medium/marched_medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grids.h"
#include "support/statistics.h"

namespace brume {
namespace {

constexpr float kScale = 3.0f;
const Ray kRay{.o = {0.5f, 0.5f, -1.0f}, .d = {0.0f, 0.0f, 1.0f}};

std::shared_ptr<const Medium> marched(const std::function<float(int, int, int)>& density,
                                      float step, const Rgb& albedo = Rgb(0.8f)) {
  return make_marched_medium<float>(test::make_grid({4, 4, 16}, density), kScale,
                                    std::make_shared<ConstantField>(albedo),
                                    HenyeyGreenstein{.g = 0.0f}, step);
}

float constant(int, int, int) {
  return 1.0f;
}
/// Opaque and clear layers in turn, four voxels each.
float layers(int, int, int z) {
  return z / 4 % 2 == 0 ? 2.0f : 0.0f;
}

TEST(MarchedMedium, ConstantDensityIsCrossedExactly) {
  Rng rng(1);
  for (const float step : {0.3f, 1.0f, 7.0f, 100.0f})
    EXPECT_NEAR(marched(constant, step)->transmittance(kRay, 5.0f, rng).g, std::exp(-kScale), 1e-5f)
        << step;
}

TEST(MarchedMedium, FlightsThroughConstantDensityAreExponential) {
  const auto medium = marched(constant, 3.0f);
  test::RunningMean passing, depth;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Sampler sampler(1, 0, i, true);
    const FreeFlight flight = medium->sample_free_flight(kRay, 5.0f, Rgb(1.0f), sampler);
    passing.add(flight.scattered ? 0.0 : 1.0);
    if (flight.scattered) depth.add(flight.t - 1.0);
    EXPECT_NEAR(flight.weight.r, flight.scattered ? 0.8f : 1.0f, 1e-5f);
  }
  const double T = std::exp(-kScale);
  EXPECT_TRUE(test::agrees(passing, T));
  // Mean of an exponential variable that ends within a unit length.
  EXPECT_TRUE(test::agrees(depth, 1.0 / kScale - T / (1.0 - T), 1e-6));
}

TEST(MarchedMedium, LongStepsPassTooMuchLightAndShortOnesTheRightAmount) {
  const auto mean_T = [](float step) {
    const auto medium = marched(layers, step);
    test::RunningMean T;
    Rng rng(2);
    for (int i = 0; i < 40000; ++i) T.add(medium->transmittance(kRay, 5.0f, rng).g);
    return T;
  };
  // The layers' mean density is 1.
  const test::RunningMean fine = mean_T(0.125f), coarse = mean_T(16.0f);
  EXPECT_NEAR(fine.mean(), std::exp(-kScale), 0.01 * std::exp(-kScale));
  EXPECT_GT(coarse.mean() - 4.5 * coarse.standard_error(), 1.5 * std::exp(-kScale));
}

TEST(MarchedMedium, FlightsAndTransmittanceTellTheSame) {
  const auto medium = marched(layers, 5.0f);
  test::RunningMean passing, T;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Sampler sampler(3, 0, i, true);
    passing.add(medium->sample_free_flight(kRay, 5.0f, Rgb(1.0f), sampler).scattered ? 0.0 : 1.0);
    T.add(medium->transmittance(kRay, 5.0f, sampler.rng()).g);
  }
  EXPECT_TRUE(test::agree(passing, T));
}

TEST(MarchedMedium, RaysBesideTheGridMeetNothing) {
  Rng rng(1);
  const Ray beside{.o = {2.0f, 0.5f, -1.0f}, .d = {0.0f, 0.0f, 1.0f}};
  EXPECT_EQ(marched(constant, 1.0f)->transmittance(beside, 5.0f, rng), Rgb(1.0f));
  Sampler sampler(1, 0, 0);
  const FreeFlight flight =
      marched(constant, 1.0f)->sample_free_flight(beside, 5.0f, Rgb(1.0f), sampler);
  EXPECT_FALSE(flight.scattered);
  EXPECT_EQ(flight.t, 5.0f);
}

}  // namespace
}  // namespace brume
