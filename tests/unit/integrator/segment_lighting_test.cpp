// SPDX-License-Identifier: Apache-2.0
#include "integrator/segment_lighting.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "light/point_light.h"
#include "light/spot_light.h"
#include "medium/homogeneous_medium.h"

namespace brume {
namespace {

const HomogeneousMedium kFog(Rgb(0.2f), Rgb(0.9f), {});

/// Shines from the origin along +Z, 15 degrees to all sides.
LightSet spot_at_the_origin() {
  const float cutoff = 15.0f * kPi / 180.0f;
  return LightSet(
      {std::make_shared<SpotLight>(glm::dmat4(1.0), Rgb(10.0f), cutoff, 0.75f * cutoff)}, {});
}

Segment segment(const Vec3& o, const Vec3& d, float t_end = kInfinity) {
  return {.ray = {o, glm::normalize(d)},
          .t_end = t_end,
          .beta = Rgb(1.0f),
          .medium = &kFog,
          .seeks_lights = true};
}

/// Sum of the density over the segment, which it samples along the way.
double integral_of_pdf(const SegmentLighting& lighting, const Segment& s) {
  const double end = std::isfinite(s.t_end) ? s.t_end : 1e4;
  double sum = 0.0;
  constexpr int kSteps = 400000;
  for (int i = 0; i < kSteps; ++i) {
    // Steps that grow with the cube, as the density is large near the begin and its tail long.
    const double a = double(i) / kSteps, b = double(i + 1) / kSteps, mid = 0.5 * (a + b);
    sum += double(lighting.pdf(0, float(end * mid * mid * mid))) * end * (b * b * b - a * a * a);
  }
  return sum;
}

class NearASpot : public ::testing::TestWithParam<Segment> {};

TEST_P(NearASpot, PointsLieInTheConeWithTheirDensity) {
  const LightSet lights = spot_at_the_origin();
  const Segment s = GetParam();
  const SegmentLighting lighting(lights, s);
  ASSERT_GT(lighting.p_near(), 0.0f);
  Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    const auto point = lighting.sample(rng.next_float(), 0.001f + 0.998f * rng.next_float());
    EXPECT_TRUE(lights.light(0).sample(s.ray.at(point.t), Vec2(0.5f))) << point.t;
    EXPECT_FLOAT_EQ(point.pdf, lighting.pdf(point.light, point.t));
  }
  EXPECT_NEAR(integral_of_pdf(lighting, s), 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Segments, NearASpot,
    ::testing::Values(segment({-5, 0, 2}, {1, 0, 0}),           // across
                      segment({-1, 0, -1}, {1, 0, 1.5f}),       // nearest outside the cone
                      segment({0.05f, 0.1f, 1}, {1, 0, 0.2f}),  // begins in the cone
                      segment({-5, 0, 2}, {1, 0, 0}, 5.0f),     // ends in it
                      segment({0.1f, 0, 0}, {0, 0, 1}),         // enters it and stays
                      segment({0, 0.1f, 3}, {0, 0, -1})));      // toward the lamp

TEST(SegmentLighting, LeavesSegmentsAloneThatNoLightReaches) {
  const LightSet lights = spot_at_the_origin();
  for (const Segment& s : {segment({-5, 0, -2}, {1, 0, 0}), segment({-5, 0, 2}, {1, 0, 0}, 4.0f),
                           segment({1, 0, 1}, {1, 0, 0.5f}), segment({0, 2, 1}, {1, 0, 0})}) {
    EXPECT_EQ(SegmentLighting(lights, s).p_near(), 0.0f);
  }
}

TEST(SegmentLighting, PointLightsAreSoughtAllAlong) {
  const LightSet lights({std::make_shared<PointLight>(Vec3(0.0f), Rgb(10.0f))}, {});
  const Segment s = segment({-5, 0.5f, 2}, {1, 0, 0}, 12.0f);
  EXPECT_NEAR(integral_of_pdf(SegmentLighting(lights, s), s), 1.0, 2e-3);
}

}  // namespace
}  // namespace brume
