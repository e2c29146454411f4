// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/rng.h"
#include "shapes.h"

namespace brume {
namespace {

/// Whether rays from far away find normals against them (an outside) or along them, everywhere.
::testing::AssertionResult shows(const test::ShapePtr& shape, bool outside) {
  const RayQueries queries = test::queries(shape);
  Rng rng(5);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 o = 20.0f * sample_uniform_sphere(rng.next_vec2());
    const Vec3 d = glm::normalize(0.5f * sample_uniform_sphere(rng.next_vec2()) - o);
    const std::optional<Hit> hit = queries.intersect({o, d}, kInfinity);
    if (!hit) continue;
    ++hits;
    if ((glm::dot(hit->n, d) < 0.0f) != outside)
      return ::testing::AssertionFailure()
             << "normal " << hit->n.x << " " << hit->n.y << " " << hit->n.z << " seen along " << d.x
             << " " << d.y << " " << d.z;
    if (!(glm::dot(hit->n, hit->n_shading) > 0.0f))
      return ::testing::AssertionFailure() << "the shading normal is on the other side";
    if (std::abs(glm::length(hit->n) - 1.0f) > 1e-6f)
      return ::testing::AssertionFailure() << "the normal has length " << glm::length(hit->n);
  }
  if (hits < 100) return ::testing::AssertionFailure() << "only " << hits << " hits";
  return ::testing::AssertionSuccess();
}

TEST(Normals, ClosedShapesPointOutwardAlsoWhenMirrored) {
  for (const glm::dmat4& m : {glm::dmat4(1.0), test::mirrored()}) {
    for (const bool flip : {false, true}) {
      EXPECT_TRUE(shows(std::make_shared<Cube>(m * test::skewed(), flip), !flip));
      EXPECT_TRUE(
          shows(std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 1.0f, flip, glm::mat3(m)), !flip));
      for (const bool face_normals : {false, true})
        EXPECT_TRUE(shows(std::make_shared<TriangleMesh>(test::sphere_mesh(2), m * test::skewed(),
                                                         face_normals, flip),
                          !flip));
    }
  }
}

TEST(Normals, ACylinderPointsAwayFromItsAxisAlsoWhenMirrored) {
  for (const glm::dmat4& m : {test::placed(2.0, Vec3d(0.0)), test::mirrored()}) {
    for (const bool flip : {false, true}) {
      const std::optional<Similarity> to_world = as_similarity(m);
      ASSERT_TRUE(to_world);
      const RayQueries queries = test::queries(
          std::make_shared<Cylinder>(Vec3(0, 0, -1), Vec3(0, 0, 2), 0.5f, *to_world, flip));
      const Vec3 axis(glm::normalize(Vec3d(m[2])));
      const Vec3 side(glm::normalize(Vec3d(m[0])));
      const std::optional<Hit> outside = queries.intersect({10.0f * side, -side}, kInfinity);
      ASSERT_TRUE(outside);
      EXPECT_NEAR(glm::dot(outside->n, side), flip ? -1.0f : 1.0f, 1e-6f);
      EXPECT_NEAR(glm::dot(outside->p, axis), 0.0f, 1e-5f);
      const std::optional<Hit> inside = queries.intersect({Vec3(0.0f), side}, kInfinity);
      ASSERT_TRUE(inside);
      EXPECT_NEAR(glm::dot(inside->n, side), flip ? -1.0f : 1.0f, 1e-6f);
      EXPECT_FALSE(queries.intersect({Vec3(0.0f), axis}, kInfinity)) << "the tube is open";
    }
  }
}

TEST(Normals, FlatShapesFollowLocalZ) {
  const glm::dmat4 upside_down = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, -1.0));
  const auto normal = [](const test::ShapePtr& shape) {
    return test::queries(shape).intersect({{0.1f, 0.1f, 5.0f}, {0, 0, -1}}, kInfinity)->n;
  };
  for (const bool flip : {false, true}) {
    const float sign = flip ? -1.0f : 1.0f;
    EXPECT_EQ(normal(std::make_shared<Rectangle>(glm::dmat4(1.0), flip)), Vec3(0, 0, sign));
    EXPECT_EQ(normal(std::make_shared<Rectangle>(test::mirrored(), flip)), Vec3(0, 0, sign));
    EXPECT_EQ(normal(std::make_shared<Rectangle>(upside_down, flip)), Vec3(0, 0, -sign));
    EXPECT_EQ(normal(std::make_shared<Disk>(glm::dmat4(1.0), flip)), Vec3(0, 0, sign));
    EXPECT_EQ(normal(std::make_shared<Disk>(test::mirrored(), flip)), Vec3(0, 0, sign));
    EXPECT_EQ(normal(std::make_shared<Disk>(upside_down, flip)), Vec3(0, 0, -sign));
  }
}

}  // namespace
}  // namespace brume
