// SPDX-License-Identifier: Apache-2.0
#include "camera/orthographic_camera.h"

#include <gtest/gtest.h>

namespace brume {
namespace {

TEST(OrthographicCamera, SpansTwoUnitsInXTimesTheScale) {
  // Scaled by (10, 10, 1), then moved to (1, 2, 3).
  const glm::dmat4 to_world(glm::dvec4(10, 0, 0, 0), glm::dvec4(0, 10, 0, 0),
                            glm::dvec4(0, 0, 1, 0), glm::dvec4(1, 2, 3, 1));
  const OrthographicCamera camera(to_world, 2.0, {.near = 0.5, .far = 100.0});
  const CameraRay top_left = camera.ray({0.0f, 0.0f}, Vec2(0.5f));
  EXPECT_EQ(top_left.ray.o, Vec3(11, 7, 3.5f));
  EXPECT_EQ(top_left.ray.d, Vec3(0, 0, 1));
  EXPECT_EQ(top_left.t_max, 99.5f);
  EXPECT_EQ(camera.ray({1.0f, 1.0f}, Vec2(0.5f)).ray.o, Vec3(-9, -3, 3.5f));
  EXPECT_EQ(camera.ray({0.5f, 0.5f}, Vec2(0.5f)).ray.o, Vec3(1, 2, 3.5f));
}

TEST(OrthographicCamera, DirectionsAreUnitWhateverTheScale) {
  const glm::dmat4 to_world(glm::dvec4(0, 0, 3, 0), glm::dvec4(0, 3, 0, 0), glm::dvec4(-3, 0, 0, 0),
                            glm::dvec4(0, 0, 0, 1));
  const OrthographicCamera camera(to_world, 1.0, {.near = 1.0, .far = 5.0});
  EXPECT_EQ(camera.ray({0.3f, 0.8f}, Vec2(0.5f)).ray.d, Vec3(-1, 0, 0));
}

}  // namespace
}  // namespace brume
