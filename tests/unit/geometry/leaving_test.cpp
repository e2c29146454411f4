// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "core/rng.h"
#include "shapes.h"

namespace brume {
namespace {

/// A convex closed shape of a given size somewhere.
struct Placement {
  double size;
  double offset;  // from the origin, in sizes
};

class Leaving : public ::testing::TestWithParam<Placement> {
 protected:
  Vec3d center() const { return GetParam().size * GetParam().offset * Vec3d(1.0, -0.7, 0.4); }
  glm::dmat4 to_world() const { return test::placed(GetParam().size, center()); }

  void expect_that_rays_keep_their_side(const test::ShapePtr& shape) const {
    const RayQueries queries = test::queries(shape);
    const float size = static_cast<float>(GetParam().size);
    Rng rng(7);
    int left = 0, found_again = 0, escaped = 0, wrongly_occluded = 0;
    while (left < 100000) {
      const Vec3 o = Vec3(center()) + 3.0f * size * sample_uniform_sphere(rng.next_vec2());
      const Vec3 target = Vec3(center()) + 0.8f * size * sample_uniform_sphere(rng.next_vec2());
      std::optional<Hit> hit = queries.intersect({o, glm::normalize(target - o)}, kInfinity);
      // From the first point outside, then from inside, a few points deep.
      for (int depth = 0; hit && depth < 4; ++depth, ++left) {
        const Vec3 d = sample_uniform_sphere(rng.next_vec2());
        const Vec3 outward = glm::dot(d, hit->n) >= 0.0f ? d : -d;
        const Ray away = hit->leave(outward);
        if (queries.intersect(away, kInfinity)) ++found_again;
        if (test::is_occluded(queries, away, kInfinity)) ++wrongly_occluded;
        const Ray inward = hit->leave(-outward);
        if (!test::is_occluded(queries, inward, kInfinity)) ++wrongly_occluded;
        hit = queries.intersect(inward, kInfinity);
        if (!hit) ++escaped;
      }
    }
    EXPECT_EQ(found_again, 0);
    EXPECT_EQ(escaped, 0);
    EXPECT_EQ(wrongly_occluded, 0);
  }
};

TEST_P(Leaving, ASphereIsNotFoundAgainFromOutsideAndAlwaysFromInside) {
  expect_that_rays_keep_their_side(
      std::make_shared<Sphere>(Vec3(center()), float(GetParam().size), false));
}

TEST_P(Leaving, ACubeIsNotFoundAgainFromOutsideAndAlwaysFromInside) {
  expect_that_rays_keep_their_side(std::make_shared<Cube>(to_world(), false));
}

TEST_P(Leaving, ASkewedCubeIsNotFoundAgainFromOutsideAndAlwaysFromInside) {
  expect_that_rays_keep_their_side(std::make_shared<Cube>(to_world() * test::skewed(), false));
}

TEST_P(Leaving, AnOctahedronIsNotFoundAgainFromOutsideAndAlwaysFromInside) {
  expect_that_rays_keep_their_side(
      std::make_shared<TriangleMesh>(test::sphere_mesh(0), to_world(), true, false));
}

INSTANTIATE_TEST_SUITE_P(Sizes, Leaving,
                         ::testing::Values(Placement{1e-6, 0.0}, Placement{1.0, 0.0},
                                           Placement{1e6, 0.0}, Placement{1e12, 0.0},
                                           Placement{1e18, 0.0}, Placement{1e-6, 1e4},
                                           Placement{1.0, 1e4}, Placement{1e6, 1e4},
                                           Placement{1e12, 1e4}));

TEST(Leaving, ARoomOfRectanglesLetsNoRayOut) {
  // The inside of the unit cube, as six surfaces that know nothing of each other.
  std::vector<test::ShapePtr> walls;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dmat4 wall(0.0);
      wall[0][(axis + 1) % 3] = 1.0;
      wall[1][(axis + 2) % 3] = 1.0;
      wall[2][axis] = 1.0;
      wall[3][axis] = side;
      wall[3][3] = 1.0;
      walls.push_back(
          std::make_shared<Rectangle>(test::placed(1.0, Vec3d(20.0, 5.0, 3.0)) * wall, side > 0.0));
    }
  }
  const RayQueries queries(walls);
  Rng rng(3);
  Ray ray{Vec3(20.0f, 5.0f, 3.0f), Vec3(1.0f, 0.0f, 0.0f)};
  for (int bounce = 0; bounce < 200000; ++bounce) {
    const std::optional<Hit> hit = queries.intersect(ray, kInfinity);
    ASSERT_TRUE(hit) << "escaped after " << bounce << " bounces";
    ASSERT_LT(glm::length(hit->p - Vec3(20.0f, 5.0f, 3.0f)), 1.7321f);
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    ray = hit->leave(glm::dot(d, hit->n) >= 0.0f ? d : -d);
  }
}

TEST(Leaving, AWideSlabIsKeptAndLosesNoneOfItsThickness) {
  // Thickness 1 and width 2e4: a step by a rounding of the width would skip a hundredth of it.
  const glm::dmat4 to_world(1e4, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1e4, 0, 0, 0, 0, 1);
  const RayQueries queries = test::queries(std::make_shared<Cube>(to_world, false));
  Rng rng(5);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 o(rng.next_float(), 1.0f + rng.next_float(), rng.next_float());
    const Vec3 d = -sample_cosine_hemisphere(rng.next_vec2());
    const std::optional<Hit> top = queries.intersect({o, Vec3(d.x, d.z, d.y)}, kInfinity);
    ASSERT_TRUE(top);
    const Ray inside = top->leave(Vec3(d.x, d.z, d.y));
    ASSERT_NEAR(inside.o.y, 0.5f, 2e-7f);
    const std::optional<Hit> bottom = queries.intersect(inside, kInfinity);
    ASSERT_TRUE(bottom);
    ASSERT_LT(bottom->p.y, 0.0f);
    ASSERT_FALSE(queries.intersect(bottom->leave(inside.d), kInfinity));
  }
}

TEST(Leaving, StepsAreAFewRoundingsLong) {
  const RayQueries queries =
      test::queries(std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 1.0f, false));
  const std::optional<Hit> hit =
      queries.intersect({{3, 2, 1}, glm::normalize(Vec3(-3, -2, -1))}, kInfinity);
  ASSERT_TRUE(hit);
  EXPECT_LT(hit->error, 1e-6f);
}

}  // namespace
}  // namespace brume
