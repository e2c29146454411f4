// SPDX-License-Identifier: Apache-2.0
#include "camera/perspective_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.h"

namespace brume {
namespace {

constexpr double kRightAngle = 0.5 * M_PI;
constexpr ClipRange kNoClip{.near = 0.0, .far = INFINITY};

void expect_near(const Vec3& got, const Vec3& want, float tolerance) {
  EXPECT_LE(max_abs(got - want), tolerance) << got.x << " " << got.y << " " << got.z << ", want "
                                            << want.x << " " << want.y << " " << want.z;
}

Vec3 direction(const Camera& camera, const Vec2& film) {
  return camera.ray(film, Vec2(0.5f)).ray.d;
}

/// Frame at `position` whose +X, +Y, +Z are the columns given.
glm::dmat4 frame(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z,
                 const glm::dvec3& position) {
  return {glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(position, 1.0)};
}

TEST(PerspectiveCamera, LooksAlongZWithXToTheLeftAndYUp) {
  const PerspectiveCamera camera({.x_fov = kRightAngle, .aspect = 2.0, .clip = kNoClip});
  expect_near(direction(camera, {0.5f, 0.5f}), {0, 0, 1}, 1e-7f);
  expect_near(direction(camera, {0.0f, 0.0f}), glm::normalize(Vec3(1, 0.5f, 1)), 1e-7f);
  expect_near(direction(camera, {1.0f, 0.0f}), glm::normalize(Vec3(-1, 0.5f, 1)), 1e-7f);
  expect_near(direction(camera, {0.0f, 1.0f}), glm::normalize(Vec3(1, -0.5f, 1)), 1e-7f);
  expect_near(direction(camera, {1.0f, 1.0f}), glm::normalize(Vec3(-1, -0.5f, 1)), 1e-7f);
}

TEST(PerspectiveCamera, ToWorldPlacesItAndMirrorsIt) {
  // At (1, 2, 3), looking along -X with +Z up: left is up x forward = Z x (-X) = -Y.
  const glm::dmat4 to_world = frame({0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, {1, 2, 3});
  const PerspectiveCamera camera(
      {.to_world = to_world, .x_fov = kRightAngle, .aspect = 1.0, .clip = kNoClip});
  EXPECT_EQ(camera.ray({0.2f, 0.7f}, Vec2(0.5f)).ray.o, Vec3(1, 2, 3));
  expect_near(direction(camera, {0.5f, 0.5f}), {-1, 0, 0}, 1e-7f);
  expect_near(direction(camera, {0.0f, 0.5f}), glm::normalize(Vec3(-1, -1, 0)), 1e-7f);
  expect_near(direction(camera, {0.5f, 0.0f}), glm::normalize(Vec3(-1, 0, 1)), 1e-7f);

  const glm::dmat4 mirror = frame({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0});
  const PerspectiveCamera mirrored(
      {.to_world = to_world * mirror, .x_fov = kRightAngle, .aspect = 1.0, .clip = kNoClip});
  expect_near(direction(mirrored, {0.2f, 0.3f}), direction(camera, {0.8f, 0.3f}), 1e-7f);
}

TEST(PerspectiveCamera, ClipPlanesCrossTheOpticalAxis) {
  const PerspectiveCamera camera(
      {.x_fov = kRightAngle, .aspect = 1.5, .clip = {.near = 0.25, .far = 8.0}});
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const CameraRay r = camera.ray(rng.next_vec2(), rng.next_vec2());
    ASSERT_NEAR(r.ray.o.z, 0.25f, 1e-6f);
    ASSERT_NEAR(r.ray.at(r.t_max).z, 8.0f, 1e-5f);
    ASSERT_NEAR(length_squared(r.ray.d), 1.0f, 5e-7f);
  }
  EXPECT_EQ(PerspectiveCamera({.x_fov = 1.0, .clip = kNoClip}).ray(Vec2(0.1f), Vec2(0.5f)).t_max,
            kInfinity);
}

TEST(PerspectiveCamera, PrincipalPointOffsetShiftsTheView) {
  const PerspectiveCamera centred({.x_fov = 1.0, .aspect = 1.5});
  const PerspectiveCamera shifted(
      {.x_fov = 1.0, .aspect = 1.5, .principal_point_offset = {0.25, -0.125}});
  expect_near(direction(shifted, {0.25f, 0.625f}), {0, 0, 1}, 1e-7f);
  expect_near(direction(shifted, {0.5f, 0.5f}), direction(centred, {0.75f, 0.375f}), 1e-7f);
}

TEST(ThinLensCamera, RaysThroughOnePixelMeetInTheFocalPlane) {
  const PerspectiveView view{.to_world = frame({0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {4, 5, 6}),
                             .x_fov = 0.8,
                             .aspect = 1.25,
                             .clip = {.near = 0.5, .far = 100.0}};
  const ThinLensCamera lens(view, 0.3, 7.0);
  const PerspectiveCamera pinhole(view);
  Rng rng(2);
  float widest = 0.0f;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 film = rng.next_vec2();
    const Ray sharp = pinhole.ray(film, Vec2(0.5f)).ray;
    const CameraRay r = lens.ray(film, rng.next_vec2());
    // The optical axis is -X and the lens stands at x = 4.
    const Vec3 in_focus = sharp.at((sharp.o.x - (4.0f - 7.0f)) / -sharp.d.x);
    expect_near(r.ray.at((r.ray.o.x - (4.0f - 7.0f)) / -r.ray.d.x), in_focus, 5e-6f);
    ASSERT_NEAR(r.ray.o.x, 4.0f - 0.5f, 1e-6f);
    ASSERT_NEAR(r.ray.at(r.t_max).x, 4.0f - 100.0f, 1e-4f);

    const Vec3 on_lens = r.ray.at((r.ray.o.x - 4.0f) / -r.ray.d.x) - Vec3(4, 5, 6);
    ASSERT_LE(glm::length(on_lens), 0.3f + 1e-5f);
    widest = std::max(widest, glm::length(on_lens));
  }
  EXPECT_GT(widest, 0.29f);
}

}  // namespace
}  // namespace brume
