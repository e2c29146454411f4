// SPDX-License-Identifier: Apache-2.0
#include "light/area_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/warp.h"
#include "geometry/disk.h"
#include "geometry/ray_queries.h"
#include "geometry/rectangle.h"
#include "geometry/sphere.h"
#include "unit/light/light_laws.h"

namespace brume {
namespace {

/// Scales by (x, y, 1), then turns the normal downward and lifts to `height`.
glm::dmat4 ceiling(double x, double y, double height) {
  return {glm::dvec4(x, 0, 0, 0), glm::dvec4(0, 0, y, 0), glm::dvec4(0, -1, 0, 0),
          glm::dvec4(0, height, 0, 1)};
}

class AreaLightOfSize : public ::testing::TestWithParam<float> {
 protected:
  float size_ = GetParam();
};

TEST_P(AreaLightOfSize, SphereIrradiatesByTheInverseSquare) {
  const auto sphere = std::make_shared<Sphere>(Vec3(0, 3 * size_, 0), size_, false);
  const AreaLight light(sphere, {1, 2, 3});
  const float tilt = 0.8f;
  const Vec3 n(std::sin(tilt), std::cos(tilt), 0);
  const auto E = test::irradiance(test::sampler_of(light), n, 100000);
  for (int c = 0; c < 3; ++c)
    EXPECT_TRUE(test::agrees(E[c], M_PI * (c + 1) / 9.0 * std::cos(tilt), 1e-6));
}

/// Form factor of a rectangle [0, a] x [0, b] at distance 1 for a parallel element below its
/// corner at the origin (Hamilton and Morgan 1952).
double corner_form_factor(double a, double b) {
  const double A = std::hypot(1.0, a), B = std::hypot(1.0, b);
  return (a / A * std::atan(b / A) + b / B * std::atan(a / B)) / (2.0 * M_PI);
}

TEST_P(AreaLightOfSize, RectangleIrradiatesByItsFormFactor) {
  const double s = double(size_);
  const auto rectangle = std::make_shared<Rectangle>(ceiling(0.5 * s, 1.5 * s, 2.0 * s), false);
  const AreaLight light(rectangle, Rgb(1.0f));
  const auto E = test::irradiance(test::sampler_of(light), {0, 1, 0}, 100000);
  const double want = M_PI * 4.0 * corner_form_factor(0.25, 0.75);
  EXPECT_TRUE(test::agrees(E[0], want, 1e-6));
}

TEST_P(AreaLightOfSize, DiskIrradiatesByItsFormFactor) {
  const double s = double(size_);
  const auto disk = std::make_shared<Disk>(ceiling(s, s, 2.0 * s), false);
  const auto E = test::irradiance(test::sampler_of(AreaLight(disk, Rgb(1.0f))), {0, 1, 0}, 100000);
  EXPECT_TRUE(test::agrees(E[0], M_PI * 1.0 / 5.0, 1e-6));
}

TEST_P(AreaLightOfSize, ShadowRayEndsInFrontOfTheLight) {
  const double s = double(size_);
  const std::vector<std::shared_ptr<const Shape>> shapes{
      std::make_shared<Sphere>(Vec3(7, 3, -4) * size_, size_, false),
      std::make_shared<Rectangle>(ceiling(s, 1.5 * s, 2.0 * s), false),
      std::make_shared<Disk>(ceiling(s, s, 2.0 * s), false)};
  for (const auto& shape : shapes) {
    const AreaLight light(shape, Rgb(1.0f));
    const RayQueries queries({&shape, 1});
    const Vec3 center = shape->bounds().center();
    Rng rng(13);
    int lit = 0, found = 0;
    for (int i = 0; i < 50000; ++i) {
      // From very near to far away, at all angles.
      const float away = size_ * std::exp(12.0f * rng.next_float() - 4.0f);
      const Vec3 on_surface = center + size_ * sample_uniform_sphere(rng.next_vec2());
      const Vec3 p = on_surface + away * sample_uniform_sphere(rng.next_vec2());
      const auto light_sample = light.sample(p, rng.next_vec2());
      if (!light_sample) continue;
      ++lit;
      ASSERT_EQ(queries.obstacle({p, light_sample->d}, light_sample->distance), Obstacle::kNone)
          << away;
      if (const auto hit = queries.intersect({p, light_sample->d}, kInfinity)) {
        ++found;
        ASSERT_EQ(light.radiance(*hit, light_sample->d), Rgb(1.0f));
      }
    }
    EXPECT_GT(lit, 10000);
    EXPECT_GT(found, 0.99 * lit);  // all but those that rounding carries past the edge
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, AreaLightOfSize, ::testing::Values(1e-6f, 1.0f, 1e6f, 1e12f));

TEST(AreaLight, EmitsOnlyToTheOutside) {
  const std::shared_ptr<const Shape> rectangle =
      std::make_shared<Rectangle>(ceiling(1, 1, 2), false);
  const AreaLight light(rectangle, {1, 2, 3});
  const RayQueries queries({&rectangle, 1});
  const auto from_below = queries.intersect({{0.1f, 0, 0.2f}, {0, 1, 0}}, kInfinity);
  const auto from_above = queries.intersect({{0.1f, 4, 0.2f}, {0, -1, 0}}, kInfinity);
  ASSERT_TRUE(from_below && from_above);
  EXPECT_EQ(light.radiance(*from_below, {0, 1, 0}), Rgb(1, 2, 3));
  EXPECT_EQ(light.radiance(*from_above, {0, -1, 0}), Rgb(0.0f));
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(light.sample({0.1f, 0, 0.2f}, rng.next_vec2()));
    EXPECT_FALSE(light.sample({0.1f, 4, 0.2f}, rng.next_vec2()));
  }
}

TEST(AreaLight, SphereTurnedInsideOutLightsItsInside) {
  const AreaLight light(std::make_shared<Sphere>(Vec3(0.0f), 2.0f, true), Rgb(1.0f));
  const auto E = test::irradiance(test::sampler_of(light, {0.5f, -1.0f, 0.3f}),
                                  glm::normalize(Vec3(1, 1, -1)), 200000);
  EXPECT_TRUE(test::agrees(E[0], M_PI));
  EXPECT_FALSE(light.sample({3, 0, 0}, {0.2f, 0.7f}));
}

TEST(AreaLight, SamplesFollowTheDensityOfTheirHits) {
  // Axis and bins fit the edge of the sphere, seen at 1 - cos = 0.4 around the axis.
  const float radius = std::sin(std::acos(0.6f));
  const std::vector<std::shared_ptr<const Shape>> shapes{
      std::make_shared<Sphere>(Vec3(0, 1, 0), radius, false),
      std::make_shared<Rectangle>(ceiling(1, 2, 1.5), false),
      std::make_shared<Disk>(ceiling(1, 1, 1), false)};
  for (const auto& shape : shapes) {
    const AreaLight light(shape, Rgb(1.0f));
    const RayQueries queries({&shape, 1});
    EXPECT_TRUE(test::samples_follow_pdf(
        [&](Rng& rng) -> std::optional<test::DirectionSample> {
          const auto s = light.sample(Vec3(0.0f), rng.next_vec2());
          if (!s) return std::nullopt;
          return test::DirectionSample{.d = s->d, .pdf = s->pdf};
        },
        [&](const Vec3& d) {
          const auto hit = queries.intersect({Vec3(0.0f), d}, kInfinity);
          return hit ? light.pdf(Vec3(0.0f), *hit) : 0.0f;
        },
        {.axis = {0, 1, 0}}));
  }
}

}  // namespace
}  // namespace brume
