// SPDX-License-Identifier: Apache-2.0
#include "light/light_set.h"

#include <gtest/gtest.h>

#include "core/warp.h"
#include "light/constant_environment.h"
#include "light/directional_light.h"
#include "light/distant_disk_light.h"
#include "light/environment_map.h"
#include "light/point_light.h"
#include "unit/light/light_laws.h"

namespace brume {
namespace {

std::shared_ptr<const EnvironmentMap> gradient() {
  std::vector<Rgb> pixels;
  for (int row = 0; row < 17; ++row)
    for (int column = 0; column < 32; ++column) pixels.emplace_back(17 - row, column, row);
  return std::make_shared<EnvironmentMap>(pixels, 32, 17, glm::dmat4(1.0), 0.1f);
}

const Vec3 kToSun = glm::normalize(Vec3(1, 1, 0.5f));

LightSet sun_sky_and_lamp() {
  return {{std::make_shared<PointLight>(Vec3(0, 2, 0), Rgb(4.0f))},
          {gradient(), std::make_shared<DistantDiskLight>(-kToSun, 0.1f, Rgb(5.0f)),
           std::make_shared<ConstantEnvironment>(Rgb(0.25f))}};
}

test::LightSampler sampler_of(const LightSet& lights) {
  return [&lights](Rng& rng) -> std::optional<LightSample> {
    const float u_choice = rng.next_float();
    const auto arrival = lights.sample(Vec3(0.0f), u_choice, rng.next_vec2());
    if (!arrival) return std::nullopt;
    return arrival->light;
  };
}

TEST(LightSet, AddsUpItsLights) {
  const LightSet lights = sun_sky_and_lamp();
  const Vec3 n(0, 1, 0);
  const glm::dvec3 sky = test::irradiance_by_quadrature(
      [map = gradient()](const Vec3& d) { return map->radiance(d); }, n, 400);
  const auto E = test::irradiance(sampler_of(lights), n, 400000);
  for (int c = 0; c < 3; ++c) {
    const double want = 4.0 / 4.0 + sky[c] + 5.0 * double(kToSun.y) + 0.25 * M_PI;
    EXPECT_TRUE(test::agrees(E[c], want, 1e-4 * want));
  }
}

TEST(LightSet, TreatsOverlappingEnvironmentsAsOne) {
  const LightSet lights = sun_sky_and_lamp();
  Rng rng(1);
  int environment_samples = 0, off = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto s = sampler_of(lights)(rng);
    if (s->pdf == kInfinity) continue;
    ++environment_samples;
    const float pdf = lights.environment_view(Vec3(0.0f), s->d).pdf;
    const Rgb L = lights.environment_radiance(s->d);
    if (std::abs(s->pdf / pdf - 1.0f) > 1e-3f) {
      ++off;  // at the edge of the disk, by rounding
      continue;
    }
    ASSERT_LE(max_abs(s->weight * s->pdf - L), 1e-3f * max_abs(L));
  }
  EXPECT_LE(off, 2);
  const float p_lamp = lights.probability(Vec3(0.0f), 0);
  EXPECT_NEAR(environment_samples, 20000 * (1.0f - p_lamp), 300);
}

TEST(LightSet, EnvironmentSamplesFollowTheMixture) {
  const LightSet lights({},
                        {gradient(), std::make_shared<ConstantEnvironment>(Rgb(1.0f)),
                         std::make_shared<DistantDiskLight>(-kToSun, std::acos(0.9f), Rgb(5.0f))});
  EXPECT_TRUE(test::samples_follow_pdf(
      [&](Rng& rng) -> std::optional<test::DirectionSample> {
        const auto s = sampler_of(lights)(rng);
        if (!s) return std::nullopt;
        return test::DirectionSample{.d = s->d, .pdf = s->pdf};
      },
      [&](const Vec3& d) { return lights.environment_view(Vec3(0.0f), d).pdf; }, {.axis = kToSun}));
}

TEST(LightSet, MultipleImportanceSamplingCountsEveryLightOnce) {
  const LightSet lights = sun_sky_and_lamp();
  const Vec3 n(0, 1, 0);
  const Frame frame(n);
  const glm::dvec3 sky = test::irradiance_by_quadrature(
      [map = gradient()](const Vec3& d) { return map->radiance(d); }, n, 400);
  const double want = 4.0 / 4.0 + sky.r + 5.0 * double(kToSun.y) + 0.25 * M_PI;

  Rng rng(9);
  test::RunningMean E;
  for (int i = 0; i < 400000; ++i) {
    double sum = 0.0;
    if (const auto s = sampler_of(lights)(rng)) {
      const float cosine = std::max(0.0f, glm::dot(s->d, n));
      sum += s->weight.r * cosine * power_heuristic(s->pdf, cosine / kPi);
    }
    const Vec3 local = sample_cosine_hemisphere(rng.next_vec2());
    const Vec3 d = frame.to_world(local);
    const float pdf_light = lights.environment_view(Vec3(0.0f), d).pdf;
    sum += lights.environment_radiance(d).r * kPi * power_heuristic(local.z / kPi, pdf_light);
    E.add(sum);
  }
  EXPECT_TRUE(test::agrees(E, want, 1e-4 * want));
}

TEST(LightSet, ProbabilitiesAddUpToOne) {
  const LightSet lights = sun_sky_and_lamp();
  float sum = 0.0f;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += lights.probability({1, 2, 3}, i);
  EXPECT_NEAR(sum, 1.0f, 1e-6f);
}

TEST(LightSet, ChoosesWhatIsImportantMostOftenAndNothingNever) {
  const LightSet lights({std::make_shared<PointLight>(Vec3(0, 1, 0), Rgb(1.0f)),
                         std::make_shared<PointLight>(Vec3(0, 10, 0), Rgb(1.0f))},
                        {});
  // A fifth is chosen uniformly, the rest by intensity over squared distance: 1 against 1/100.
  EXPECT_NEAR(lights.probability(Vec3(0.0f), 0), 0.1 + 0.8 * 1.0 / 1.01, 1e-6);
  EXPECT_NEAR(lights.probability(Vec3(0.0f), 1), 0.1 + 0.8 * 0.01 / 1.01, 1e-6);
  EXPECT_TRUE(std::isfinite(lights.probability({0, 1, 0}, 0)));  // on the light itself
}

TEST(LightSet, LeavesAnEvenEnvironmentToPathsThatLeaveTheScene) {
  const auto even = std::make_shared<ConstantEnvironment>(Rgb(3.0f));
  const LightSet with_lamp({std::make_shared<PointLight>(Vec3(0, 2, 0), Rgb(0.1f))}, {even});
  EXPECT_EQ(with_lamp.probability(Vec3(0.0f), 0), 1.0f);
  EXPECT_EQ(with_lamp.probability(Vec3(0.0f), 1), 0.0f);
  EXPECT_EQ(with_lamp.sample(Vec3(0.0f), 0.999f, Vec2(0.5f))->index, 0u);
  EXPECT_EQ(with_lamp.environment_view(Vec3(0.0f), {0, 1, 0}).L, Rgb(3.0f));
  EXPECT_EQ(with_lamp.environment_view(Vec3(0.0f), {0, 1, 0}).pdf, 0.0f);

  const LightSet alone({}, {even});
  EXPECT_EQ(alone.probability(Vec3(0.0f), 0), 0.0f);
  EXPECT_FALSE(alone.sample(Vec3(0.0f), 0.5f, Vec2(0.5f)));
  EXPECT_EQ(alone.environment_view(Vec3(0.0f), {0, 1, 0}).L, Rgb(3.0f));
}

TEST(LightSet, AddsUpManyLamps) {
  std::vector<std::shared_ptr<const Light>> lamps;
  Rng rng(4);
  double want = 0.0;
  for (int i = 0; i < 300; ++i) {
    const float x = rng.next_float(), y = rng.next_float(), z = rng.next_float();
    const Vec3 p(4.0f * x - 2.0f, 0.5f + y, 4.0f * z - 2.0f);
    lamps.push_back(std::make_shared<PointLight>(p, Rgb(1.0f)));
    want += double(p.y) / std::pow(double(length_squared(p)), 1.5);
  }
  const LightSet lights(lamps, {gradient()});
  float sum = 0.0f;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += lights.probability(Vec3(0.0f), i);
  EXPECT_NEAR(sum, 1.0f, 1e-5f);

  const Vec3 n(0, 1, 0);
  const glm::dvec3 sky = test::irradiance_by_quadrature(
      [map = gradient()](const Vec3& d) { return map->radiance(d); }, n, 400);
  const auto E = test::irradiance(sampler_of(lights), n, 400000);
  EXPECT_TRUE(test::agrees(E[0], want + sky.r, 1e-4 * want));
}

TEST(LightSet, ChoosesAmongLightsTooFaintToWeigh) {
  const Rgb faint(1e-38f);
  const LightSet lights({std::make_shared<PointLight>(Vec3(0, 100, 0), faint),
                         std::make_shared<PointLight>(Vec3(0, 200, 0), faint)},
                        {});
  EXPECT_EQ(lights.probability(Vec3(0.0f), 0), 0.5f);
  EXPECT_EQ(lights.sample(Vec3(0.0f), 0.7f, Vec2(0.5f))->p_choice, 0.5f);
}

TEST(LightSet, WithoutLightsIsDark) {
  const LightSet lights({}, {});
  EXPECT_FALSE(lights.sample(Vec3(0.0f), 0.5f, Vec2(0.5f)));
  EXPECT_TRUE(is_black(lights.environment_radiance({0, 1, 0})));
  EXPECT_EQ(lights.environment_view(Vec3(0.0f), {0, 1, 0}).pdf, 0.0f);
}

}  // namespace
}  // namespace brume
