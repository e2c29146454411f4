// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray_queries.h"

#include <gtest/gtest.h>

#include <future>

#include "core/rng.h"
#include "shapes.h"

namespace brume {
namespace {

TEST(RayQueries, FindsTheNearestShapeWithinTheSegment) {
  const std::vector<test::ShapePtr> shapes{
      std::make_shared<Sphere>(Vec3(0, 0, 10), 1.0f, false),
      std::make_shared<Sphere>(Vec3(0, 0, 5), 1.0f, false),
  };
  const RayQueries queries(shapes);
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(queries.intersect(ray, kInfinity)->shape, 1u);
  EXPECT_EQ(queries.intersect(ray, kInfinity)->t, 4.0f);
  EXPECT_FALSE(queries.intersect(ray, 4.0f));
  EXPECT_FALSE(test::is_occluded(queries, ray, 4.0f));
  EXPECT_TRUE(queries.intersect(ray, 4.000001f));
  EXPECT_TRUE(test::is_occluded(queries, ray, 4.000001f));
  EXPECT_EQ(queries.intersect({{0, 0, 7}, {0, 0, 1}}, kInfinity)->shape, 0u);
  EXPECT_FALSE(queries.intersect({{0, 0, 12}, {0, 0, 1}}, kInfinity));
}

TEST(RayQueries, TheFirstOfCoincidentSurfacesAnswers) {
  const auto rectangle = std::make_shared<Rectangle>(glm::dmat4(1.0), false);
  const auto disk = std::make_shared<Disk>(glm::dmat4(1.0), false);
  for (const std::vector<test::ShapePtr>& shapes :
       {std::vector<test::ShapePtr>{rectangle, disk, rectangle},
        std::vector<test::ShapePtr>{disk, rectangle, disk}}) {
    const RayQueries queries(shapes);
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
      const Vec2 xy = 0.7f * sample_disk(rng.next_vec2());
      EXPECT_EQ(queries.intersect({{xy.x, xy.y, 3.0f}, {0, 0, -1}}, kInfinity)->shape, 0u);
    }
  }
}

TEST(RayQueries, DistanceIsRightToFloatPrecisionWhereThePointIsNot) {
  // A slab a millionth thick, far from the origin in its own plane.
  constexpr float kThickness = 1e-6f;
  glm::dmat4 lower(1.0), upper(1.0);
  lower[3] = glm::dvec4(5000.0, 3000.0, 0.0, 1.0);
  upper[3] = glm::dvec4(5000.0, 3000.0, kThickness, 1.0);
  const RayQueries queries(std::vector<test::ShapePtr>{std::make_shared<Rectangle>(lower, false),
                                                       std::make_shared<Rectangle>(upper, false)});
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 xy = 0.9f * sample_disk(rng.next_vec2());
    const Vec3 d = sample_cosine_hemisphere(rng.next_vec2());
    if (d.z < 0.01f) continue;
    const Ray ray{{5000.0f + xy.x, 3000.0f + xy.y, 0.25f * kThickness}, d};
    const std::optional<Hit> hit = queries.intersect(ray, kInfinity);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->shape, 1u);
    EXPECT_NEAR(hit->t, 0.75f * kThickness / d.z, 2e-7f * hit->t);
  }
}

TEST(RayQueries, SeesSmallThingsInWideScenes) {
  // A thousandth of a unit, beside a floor a million units wide.
  const std::vector<test::ShapePtr> shapes{
      std::make_shared<Rectangle>(test::placed(1e6, Vec3d(0.0, 0.0, -3e6)), false),
      std::make_shared<TriangleMesh>(test::sphere_mesh(3), test::placed(1e-3, Vec3d(0.0)), false,
                                     false),
      std::make_shared<Sphere>(Vec3(1.0f, 0.0f, 0.0f), 1e-3f, false),
  };
  const RayQueries queries(shapes);
  Rng rng(3);
  for (int i = 0; i < 10000; ++i) {
    for (const float x : {0.0f, 1.0f}) {
      const Vec3 from = Vec3(x, 0, 0) + 0.01f * sample_uniform_sphere(rng.next_vec2());
      const Vec3 to = Vec3(x, 0, 0) + 0.0006f * sample_uniform_sphere(rng.next_vec2());
      const std::optional<Hit> hit =
          queries.intersect({from, glm::normalize(to - from)}, kInfinity);
      ASSERT_TRUE(hit);
      ASSERT_EQ(hit->shape, x == 0.0f ? 1u : 2u);
      ASSERT_LE(glm::length(hit->p - Vec3(x, 0, 0)), 1.001e-3f);
    }
  }
}

TEST(RayQueries, SeesThingsFromFarAway) {
  Rng rng(4);
  for (const float distance : {10.0f, 1e4f, 1e8f, 1e15f}) {
    for (const test::ShapePtr& shape : std::vector<test::ShapePtr>{
             std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 1.0f, false),
             std::make_shared<TriangleMesh>(test::sphere_mesh(4), glm::dmat4(1.0), false, false),
             std::make_shared<Cube>(glm::dmat4(0.6), false)}) {
      const RayQueries queries = test::queries(shape);
      for (int i = 0; i < 1000; ++i) {
        const Vec2 xy = 0.5f * sample_disk(rng.next_vec2());
        const std::optional<Hit> hit =
            queries.intersect({{xy.x, xy.y, distance}, {0, 0, -1}}, kInfinity);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->t, distance - hit->p.z, 2e-7f * distance);
        EXPECT_NEAR(hit->p.x, xy.x, 1e-6f);
        EXPECT_NEAR(hit->p.y, xy.y, 1e-6f);
        const Ray ray{{xy.x, xy.y, distance}, {0, 0, -1}};
        EXPECT_FALSE(test::is_occluded(queries, ray, hit->t * (1.0f - 2e-7f)));
        EXPECT_TRUE(test::is_occluded(queries, ray, hit->t * (1.0f + 2e-7f)));
      }
    }
  }
}

TEST(RayQueries, NamesAllSurfacesAtTheSamePlace) {
  for (const double offset : {0.0, 1.0, 1e3}) {
    // Two cubes that share a face, turned so that rounding moves the one against the other.
    const glm::dmat4 to_world = test::placed(1.0, offset * glm::dvec3(1.0, -0.7, 0.4));
    const auto cube_at = [&](double x) {
      return std::make_shared<Cube>(glm::translate(to_world, glm::dvec3(x, 0.0, 0.0)), false);
    };
    const RayQueries queries(std::vector<test::ShapePtr>{cube_at(-1.0), cube_at(1.0)});
    Rng rng(6);
    for (int i = 0; i < 10000; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const Vec2 from = 0.9f * (2.0f * rng.next_vec2() - 1.0f);
      const Vec2 to = 0.9f * (2.0f * rng.next_vec2() - 1.0f);
      const Vec3 o(to_world * glm::dvec4(side, from, 1.0));
      const Vec3 target(to_world * glm::dvec4(0.0, to, 1.0));
      const std::optional<Hit> hit = queries.intersect({o, glm::normalize(target - o)}, kInfinity);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->shape, 0u);
      ASSERT_EQ(hit->coincident_count, 1u);
      EXPECT_EQ(hit->coincident[0].shape, 1u);
      EXPECT_FALSE(hit->coincident[0].faces_alike);
    }
  }
}

TEST(RayQueries, AnswersTheSameInEveryThread) {
  const std::vector<test::ShapePtr> shapes{
      std::make_shared<TriangleMesh>(test::sphere_mesh(4), test::skewed(), false, false),
      std::make_shared<Cube>(glm::dmat4(0.6), false),
  };
  const RayQueries queries(shapes);
  const auto distances = [&queries] {
    Rng rng(5);
    std::vector<float> result;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 o = 2.0f * sample_uniform_sphere(rng.next_vec2());
      const std::optional<Hit> hit =
          queries.intersect({o, sample_uniform_sphere(rng.next_vec2())}, kInfinity);
      result.push_back(hit ? hit->t : 0.0f);
    }
    return result;
  };
  const std::vector<float> alone = distances();
  std::vector<std::future<std::vector<float>>> together;
  for (int i = 0; i < 4; ++i) together.push_back(std::async(std::launch::async, distances));
  for (auto& result : together) EXPECT_EQ(result.get(), alone);
}

TEST(RayQueries, TellsTheMostOfWhatStandsInTheWay) {
  const auto at = [](float z) { return std::make_shared<Sphere>(Vec3(0, 0, z), 1.0f, false); };
  const std::vector<test::ShapePtr> shapes{at(3.0f), at(6.0f), at(9.0f)};
  const RayQueries queries(shapes, {true, false, true});
  const Ray along{{0, 0, 0}, {0, 0, 1}}, back{{0, 0, 12}, {0, 0, -1}};
  EXPECT_EQ(queries.obstacle(along, 1.9f), Obstacle::kNone);
  EXPECT_EQ(queries.obstacle(along, 2.1f), Obstacle::kPassable);
  EXPECT_EQ(queries.obstacle(along, 5.1f), Obstacle::kOpaque);
  EXPECT_EQ(queries.obstacle(back, 4.9f), Obstacle::kPassable);
  EXPECT_EQ(queries.obstacle(back, kInfinity), Obstacle::kOpaque);
  EXPECT_EQ(queries.obstacle({{0, 0, 9}, {0, 0, 1}}, kInfinity), Obstacle::kPassable);
}

TEST(RayQueries, MovesWithItsOwner) {
  RayQueries queries = test::queries(std::make_shared<Sphere>(Vec3(0, 0, 5), 1.0f, false));
  RayQueries moved = std::move(queries);
  EXPECT_TRUE(test::is_occluded(moved, {{0, 0, 0}, {0, 0, 1}}, kInfinity));
}

}  // namespace
}  // namespace brume
