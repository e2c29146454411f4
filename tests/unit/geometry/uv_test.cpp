// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "shapes.h"

namespace brume {
namespace {

Hit seen(const test::ShapePtr& shape, const Vec3& from, const Vec3& d) {
  const std::optional<Hit> hit = test::queries(shape).intersect({from, d}, kInfinity);
  EXPECT_TRUE(hit);
  return hit.value_or(Hit{});
}

void expect_near(const Vec2& got, const Vec2& want) {
  EXPECT_NEAR(got.x, want.x, 1e-6f);
  EXPECT_NEAR(got.y, want.y, 1e-6f);
}

TEST(Uv, OfARectangleIsItsPlaceAlongTheLocalAxes) {
  const Hit hit =
      seen(std::make_shared<Rectangle>(glm::dmat4(1.0), false), {0.5f, -0.8f, 3.0f}, {0, 0, -1});
  expect_near(hit.uv, {0.75f, 0.1f});
  EXPECT_EQ(hit.dp_du, Vec3(2, 0, 0));
}

TEST(Uv, OfASphereIsAzimuthAndAngleFromLocalZ) {
  const auto sphere = std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 2.0f, false);
  expect_near(seen(sphere, {5, 0, 0}, {-1, 0, 0}).uv, {0.0f, 0.5f});
  expect_near(seen(sphere, {0, 5, 0}, {0, -1, 0}).uv, {0.25f, 0.5f});
  expect_near(seen(sphere, {0, -5, 0}, {0, 1, 0}).uv, {0.75f, 0.5f});
  expect_near(seen(sphere, {1e-4f, 0, 5}, {0, 0, -1}).uv, {0.0f, 0.5e-4f / kPi});
  EXPECT_NEAR(seen(sphere, {0, 5, 0}, {0, -1, 0}).dp_du.x, -4.0f * kPi, 1e-5f);

  // Local +Z points along world +X.
  const glm::mat3 orientation(Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0));
  const auto turned = std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 2.0f, false, orientation);
  expect_near(seen(turned, {0, 5, 0}, {0, -1, 0}).uv, {0.0f, 0.5f});
  expect_near(seen(turned, {0, 0, 5}, {0, 0, -1}).uv, {0.25f, 0.5f});
  EXPECT_NEAR(seen(turned, {5, 0, 0}, {-1, 0, 0}).uv.y, 0.0f, 1e-6f);
}

TEST(Uv, OfADiskIsRadiusAndAzimuth) {
  const Hit hit =
      seen(std::make_shared<Disk>(glm::dmat4(1.0), false), {0.0f, -0.5f, 3.0f}, {0, 0, -1});
  expect_near(hit.uv, {0.5f, 0.75f});
}

TEST(Uv, OfACylinderIsAzimuthAndPlaceAlongTheAxis) {
  const auto tube = std::make_shared<Cylinder>(Vec3(0, 0, 0), Vec3(0, 0, 4), 1.0f,
                                               *as_similarity(glm::dmat4(1.0)), false);
  expect_near(seen(tube, {5, 0, 1}, {-1, 0, 0}).uv, {0.0f, 0.25f});
  expect_near(seen(tube, {0, 5, 3}, {0, -1, 0}).uv, {0.25f, 0.75f});
}

TEST(Uv, OfACubeIsThatOfMitsuba) {
  const auto cube = std::make_shared<Cube>(glm::dmat4(1.0), false);
  expect_near(seen(cube, {0.5f, 0.2f, -8}, {0, 0, 1}).uv, {0.4f, 0.75f});
  expect_near(seen(cube, {0.5f, 0.2f, 8}, {0, 0, -1}).uv, {0.6f, 0.75f});
  expect_near(seen(cube, {-8, 0.5f, 0.2f}, {1, 0, 0}).uv, {0.75f, 0.6f});
  expect_near(seen(cube, {8, 0.5f, 0.2f}, {-1, 0, 0}).uv, {0.75f, 0.4f});
  expect_near(seen(cube, {0.5f, -8, 0.2f}, {0, 1, 0}).uv, {0.6f, 0.75f});
  expect_near(seen(cube, {0.5f, 8, 0.2f}, {0, -1, 0}).uv, {0.25f, 0.4f});
}

TEST(Uv, TangentIsTheDerivativeOfThePoint) {
  const std::vector<test::ShapePtr> shapes{
      std::make_shared<Rectangle>(test::skewed(), false),
      std::make_shared<Disk>(test::skewed(), false),
      std::make_shared<Cube>(test::skewed(), false),
      std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 1.0f, false),
  };
  for (const test::ShapePtr& shape : shapes) {
    const Vec3 from(0.3f, 0.25f, 4.0f), d(0, 0, -1);
    const Hit a = seen(shape, from, d);
    constexpr float kStep = 1e-3f;
    const Hit b = seen(shape, from + kStep * a.dp_du, d);
    EXPECT_NEAR(b.uv.x - a.uv.x, kStep, 0.02f * kStep);
    EXPECT_NEAR(b.uv.y, a.uv.y, 0.02f * kStep);
  }
}

}  // namespace
}  // namespace brume
