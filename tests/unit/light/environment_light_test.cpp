// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "light/constant_environment.h"
#include "light/distant_disk_light.h"
#include "unit/light/light_laws.h"

namespace brume {
namespace {

TEST(ConstantEnvironment, IsSampledAsSeen) {
  EXPECT_TRUE(test::is_sampled_as_seen(ConstantEnvironment({1, 2, 3})));
}

TEST(ConstantEnvironment, IrradiatesWithPiTimesItsRadiance) {
  const ConstantEnvironment light({1, 2, 3});
  const auto E = test::irradiance(test::sampler_of(light), {0.6f, 0, 0.8f}, 200000);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(test::agrees(E[c], M_PI * (c + 1)));
}

TEST(DistantDiskLight, IsSampledAsSeen) {
  // A disk whose edge is the edge of the tenth row of bins.
  const Vec3 direction = glm::normalize(Vec3(1, -2, 0.5f));
  const DistantDiskLight light(direction, std::acos(0.9f), {3, 2, 1});
  EXPECT_TRUE(test::is_sampled_as_seen(light, {.axis = -direction, .cosine_bins = 200}));
}

class DistantDisk : public ::testing::TestWithParam<float> {
 protected:
  float radius_ = GetParam();
  Vec3 to_light_ = glm::normalize(Vec3(-1, 2, -0.5f));
  DistantDiskLight light_{-to_light_, radius_, {3, 2, 1}};
};

TEST_P(DistantDisk, IsSampledUniformly) {
  Rng rng(5);
  const Frame frame(to_light_);
  const double one_minus_cos_max = 2.0 * std::pow(std::sin(0.5 * radius_), 2);
  test::RunningMean height, height_squared, x, y;
  for (int i = 0; i < 100000; ++i) {
    const auto s = light_.sample(Vec3(0.0f), rng.next_vec2());
    const double h = double(one_minus_cos(s->d, to_light_)) / one_minus_cos_max;
    const Vec3 local = frame.to_local(s->d);
    height.add(h);
    height_squared.add(h * h);
    x.add(double(local.x) / radius_);
    y.add(double(local.y) / radius_);
  }
  const double rounding = 2e-7 / radius_;
  EXPECT_TRUE(test::agrees(height, 1.0 / 2.0, rounding));
  EXPECT_TRUE(test::agrees(height_squared, 1.0 / 3.0, rounding));
  EXPECT_TRUE(test::agrees(x, 0.0, rounding));
  EXPECT_TRUE(test::agrees(y, 0.0, rounding));
}

TEST_P(DistantDisk, BringsItsIrradianceTimesTheCosine) {
  // Exact as long as no part of the disk is below the horizon of the surface.
  const float tilt = std::min(0.5f, 0.5f * kPi - radius_);
  const Vec3 n = Frame(to_light_).to_world({std::sin(tilt), 0, std::cos(tilt)});
  const auto E = test::irradiance(test::sampler_of(light_), n, 100000);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(test::agrees(E[c], (3.0 - c) * std::cos(tilt), 1e-6));
}

TEST_P(DistantDisk, IsSeenUpToItsAngularRadius) {
  const Frame frame(to_light_);
  const auto at = [&](float angle) {
    return frame.to_world({std::sin(angle), 0, std::cos(angle)});
  };
  EXPECT_FALSE(is_black(light_.radiance(at(0.0f))));
  EXPECT_FALSE(is_black(light_.radiance(at(0.999f * radius_))));
  EXPECT_TRUE(is_black(light_.radiance(at(1.001f * radius_))));
  EXPECT_EQ(light_.pdf(at(1.001f * radius_)), 0.0f);
  EXPECT_TRUE(is_black(light_.radiance(-to_light_)));
}

INSTANTIATE_TEST_SUITE_P(AngularRadii, DistantDisk, ::testing::Values(1e-3f, 4.65e-3f, 0.1f, 1.5f));

}  // namespace
}  // namespace brume
