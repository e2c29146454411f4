// SPDX-License-Identifier: Apache-2.0
#include "light/sky.h"

#include <gtest/gtest.h>

#include "core/warp.h"
#include "unit/light/light_laws.h"

namespace brume {
namespace {

/// Toward a sun `elevation_deg` above the horizon.
Vec3 sun_at(float elevation_deg) {
  const float a = elevation_deg * kPi / 180.0f;
  return glm::normalize(Vec3(0.6f * std::cos(a), std::sin(a), -0.8f * std::cos(a)));
}

double luminance_of(const glm::dvec3& c) {
  return double(luminance(Rgb(c)));
}

glm::dvec3 sky_irradiance(const Daylight& day, const Vec3& n) {
  return test::irradiance_by_quadrature([&](const Vec3& d) { return day.sky->radiance(d); }, n,
                                        256);
}

Rgb sun_irradiance(const Daylight& day, const Vec3& to_sun) {
  return day.sun->radiance(to_sun) / day.sun->pdf(to_sun);
}

class DaylightLaw : public ::testing::TestWithParam<std::tuple<float, float>> {
 protected:
  Vec3 to_sun_ = sun_at(std::get<0>(GetParam()));
  float turbidity_ = std::get<1>(GetParam());
  Daylight day_ = make_daylight(to_sun_, turbidity_);
};

TEST_P(DaylightLaw, WhiteFacingTheSunHasLuminanceOne) {
  const double E =
      luminance_of(sky_irradiance(day_, to_sun_)) + luminance(sun_irradiance(day_, to_sun_));
  EXPECT_NEAR(E / M_PI, 1.0, 0.01);
}

TEST_P(DaylightLaw, SkyIsFiniteBlueAndSymmetricAboutTheSun) {
  // Mirrored across the vertical plane through the sun.
  const Vec3 across = glm::normalize(glm::cross(to_sun_, Vec3(0, 1, 0)));
  Rng rng(1);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    const Rgb L = day_.sky->radiance(d);
    ASSERT_TRUE(is_finite_and_non_negative(L) && max_component(L) > 0.0f);
    if (std::abs(d.y) < 0.02f) continue;  // the edge of the ground is not resolved exactly
    const Rgb mirrored = day_.sky->radiance(d - 2.0f * glm::dot(d, across) * across);
    ASSERT_LE(max_abs(L - mirrored), 0.02f * max_abs(L));
  }
}

TEST_P(DaylightLaw, GroundIsGreyerAndDarkerThanWhiteInTheOpen) {
  const Rgb ground = day_.sky->radiance({0, -1, 0});
  const double white = (luminance_of(sky_irradiance(day_, {0, 1, 0})) +
                        double(to_sun_.y * luminance(sun_irradiance(day_, to_sun_)))) /
                       M_PI;
  EXPECT_NEAR(luminance(ground) / white, 0.2, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Days, DaylightLaw,
                         ::testing::Combine(::testing::Values(0.0f, 5.0f, 45.0f, 90.0f),
                                            ::testing::Values(2.0f, 3.0f, 10.0f)));

TEST(Daylight, ZenithIsBlueAndTheSunIsWarm) {
  const Daylight day = make_daylight(sun_at(45.0f), 3.0f);
  const Rgb zenith = day.sky->radiance({0, 1, 0});
  EXPECT_GT(zenith.b, 2.0f * zenith.r);
  const Rgb sun = day.sun->radiance(sun_at(45.0f));
  EXPECT_GT(sun.r, sun.g);
  EXPECT_GT(sun.g, sun.b);
}

TEST(Daylight, LowSunIsWeakerAndRedderComparedWithTheSky) {
  double ratio = INFINITY, redness = 0.0;
  for (const float elevation : {45.0f, 20.0f, 8.0f, 2.0f}) {
    const Daylight day = make_daylight(sun_at(elevation), 3.0f);
    const Rgb sun = sun_irradiance(day, sun_at(elevation));
    const double sky = luminance_of(sky_irradiance(day, {0, 1, 0}));
    EXPECT_LT(luminance(sun) / sky, ratio) << elevation;
    EXPECT_GT(double(sun.r / sun.b), redness) << elevation;
    ratio = luminance(sun) / sky;
    redness = double(sun.r / sun.b);
  }
}

TEST(Daylight, SunOutshinesTheSkyAsMeasured) {
  // Under a clear sky at 45 degrees the direct share of the horizontal illuminance is 70 to 85 %.
  const Vec3 to_sun = sun_at(45.0f);
  const Daylight day = make_daylight(to_sun, 3.0f);
  const double direct = double(to_sun.y * luminance(sun_irradiance(day, to_sun)));
  const double diffuse = luminance_of(sky_irradiance(day, {0, 1, 0}));
  EXPECT_GT(direct / (direct + diffuse), 0.65);
  EXPECT_LT(direct / (direct + diffuse), 0.85);
}

}  // namespace
}  // namespace brume
