// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"
#include "light/directional_light.h"
#include "light/point_light.h"
#include "light/spot_light.h"

namespace brume {
namespace {

const Vec2 kAnyU{0.3f, 0.6f};

TEST(PointLight, FallsOffWithTheSquareOfTheDistanceAtEveryScale) {
  const Vec3 toward = glm::normalize(Vec3(1, -2, 2));
  for (const float r : {1e-15f, 1e-3f, 1.0f, 1e6f, 9.46e15f}) {
    const PointLight light(r * toward, {1.0f, 2.0f, 3.0f});
    const auto s = light.sample(Vec3(0.0f), kAnyU);
    ASSERT_TRUE(s);
    EXPECT_LE(max_abs(s->d - toward), 1e-6f);
    EXPECT_NEAR(s->distance / r, 1.0f, 1e-6f);
    EXPECT_EQ(s->pdf, kInfinity);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(s->weight[c] * r * r, float(c + 1), 1e-5f) << r;
  }
}

TEST(PointLight, GivesNothingAtItsOwnPosition) {
  EXPECT_FALSE(PointLight({1, 2, 3}, Rgb(1.0f)).sample({1, 2, 3}, kAnyU));
}

TEST(SpotLight, FallsOffLinearlyInTheAngleBetweenBeamAndCutoff) {
  const float cutoff = 0.5f, beam = 0.2f;
  // At (0, 3, 0), looking down along -Y, and scaled, which must not matter.
  const glm::dmat4 to_world(glm::dvec4(2, 0, 0, 0), glm::dvec4(0, 0, 2, 0), glm::dvec4(0, -2, 0, 0),
                            glm::dvec4(0, 3, 0, 1));
  const SpotLight light(to_world, Rgb(5.0f), cutoff, beam);
  for (float angle = 0.0f; angle < 1.5f; angle += 0.01f) {
    for (const float azimuth : {0.0f, 2.0f, 4.0f}) {
      const float r = 4.0f;
      const Vec3 p = Vec3(0, 3, 0) + r * Vec3(std::sin(angle) * std::cos(azimuth), -std::cos(angle),
                                              std::sin(angle) * std::sin(azimuth));
      const auto s = light.sample(p, kAnyU);
      const float want = std::clamp((cutoff - angle) / (cutoff - beam), 0.0f, 1.0f) * 5.0f / 16.0f;
      EXPECT_NEAR(s ? s->weight.r : 0.0f, want, 1e-5f) << angle;
      if (s) {
        EXPECT_LE(max_abs(p + s->distance * s->d - Vec3(0, 3, 0)), 2e-6f);
        EXPECT_EQ(s->pdf, kInfinity);
      }
    }
  }
}

TEST(SpotLight, WithoutTransitionIsAHardCone) {
  const SpotLight light(glm::dmat4(1.0), Rgb(1.0f), 0.3f, 0.3f);
  EXPECT_NEAR(light.sample({std::sin(0.299f), 0, std::cos(0.299f)}, kAnyU)->weight.r, 1.0f, 1e-6f);
  EXPECT_FALSE(light.sample({std::sin(0.301f), 0, std::cos(0.301f)}, kAnyU));
  EXPECT_FALSE(light.sample({0, 0, -1}, kAnyU));
}

TEST(DirectionalLight, IsTheSameEverywhere) {
  const DirectionalLight light({0, -3, 0}, {1, 2, 3});
  for (const Vec3& p : {Vec3(0.0f), Vec3(1e9f, -5, 2)}) {
    const auto s = light.sample(p, kAnyU);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->d, Vec3(0, 1, 0));
    EXPECT_EQ(s->weight, Rgb(1, 2, 3));
    EXPECT_EQ(s->distance, kInfinity);
    EXPECT_EQ(s->pdf, kInfinity);
  }
}

}  // namespace
}  // namespace brume
