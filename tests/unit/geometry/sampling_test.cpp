// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/rng.h"
#include "shapes.h"
#include "support/chi_square.h"
#include "support/statistics.h"

namespace brume {
namespace {

/// A shape and a point from which every part that sampling may choose is seen.
struct View {
  std::string name;
  test::ShapePtr shape;
  Vec3 from;
};

std::vector<View> views() {
  const glm::dmat4 unit(1.0);
  const auto sphere = std::make_shared<Sphere>(Vec3(0.2f, 0.0f, 0.0f), 1.0f, false);
  const auto small_sphere = std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 1e-3f, true);
  const auto rectangle = std::make_shared<Rectangle>(test::placed(1.0, Vec3d(0.0)), false);
  const auto skewed_rectangle = std::make_shared<Rectangle>(test::skewed(), false);
  const auto disk = std::make_shared<Disk>(test::skewed(), true);
  const auto tube =
      std::make_shared<Cylinder>(Vec3(0, 0, -1), Vec3(0, 0, 1), 0.5f, *as_similarity(unit), false);
  const auto cube = std::make_shared<Cube>(test::skewed(), false);
  const auto mesh = std::make_shared<TriangleMesh>(test::sphere_mesh(1), unit, true, false);
  return {
      {"SphereFromOutside", sphere, {1.0f, 2.0f, -0.5f}},
      {"SphereFromNearby", sphere, {1.21f, 0.0f, 0.0f}},
      {"SphereFromInside", sphere, {0.7f, 0.3f, -0.4f}},
      {"SmallSphere", small_sphere, {2.7e-3f, 0.0f, 0.0f}},
      {"RectangleFromAbove", rectangle, {0.3f, 0.4f, 1.0f}},
      {"RectangleFromNearby", rectangle, {0.05f, 0.02f, 0.03f}},
      {"RectangleFromAside", rectangle, {3.0f, 1.0f, 0.2f}},
      {"SkewedRectangle", skewed_rectangle, {0.2f, 0.1f, -0.8f}},
      {"Disk", disk, {0.2f, 0.1f, 0.7f}},
      {"CylinderFromInside", tube, {0.1f, -0.2f, 0.3f}},
      {"CubeFromACorner", cube, {2.0f, 1.8f, 1.5f}},
      {"CubeFromASide", cube, {0.3f, 0.1f, 1.4f}},
      {"CubeFromInside", cube, {0.2f, 0.1f, 0.0f}},
      {"MeshFromInside", mesh, {0.2f, -0.3f, 0.1f}},
  };
}

class Sampling : public ::testing::TestWithParam<View> {
 protected:
  const Shape& shape() const { return *GetParam().shape; }
  Vec3 from() const { return GetParam().from; }
};

TEST_P(Sampling, PointsLieOnTheSurfaceAndStateTheirDensity) {
  const RayQueries queries = test::queries(GetParam().shape);
  Rng rng(1);
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::optional<ShapeSample> s = shape().sample_toward(from(), rng.next_vec2());
    if (!s) continue;
    const Vec3 d = glm::normalize(s->p - from());
    const float distance = glm::length(s->p - from());
    const float cosine = std::abs(glm::dot(d, s->n));
    if (cosine < 1e-2f) continue;  // the ray finds the point to within rounding over the cosine
    const std::optional<Hit> hit = queries.intersect({from(), d}, kInfinity);
    if (!hit) continue;
    ++seen;
    const float tolerance = (5e-7f * (distance + max_abs(s->p)) + 4.0f * s->error) / cosine;
    ASSERT_LT(glm::length(hit->p - s->p), tolerance) << i;
    ASSERT_NEAR(shape().pdf_toward(from(), *hit) / s->pdf, 1.0f, 20.0f * tolerance / distance);
    ASSERT_GT(glm::dot(hit->n, s->n), 0.999f);
    ASSERT_NEAR(glm::length(s->n), 1.0f, 1e-6f);
  }
  // Only rays to the very edge may miss.
  EXPECT_GT(seen, 18000);
}

TEST_P(Sampling, DrawsDirectionsWithItsDensity) {
  const RayQueries queries = test::queries(GetParam().shape);
  const Vec3 way = shape().bounds().center() - from();
  const test::ChiSquareSettings settings{
      .axis = glm::normalize(way), .samples = 50000, .pdf_tolerance = 0.02f};
  EXPECT_TRUE(test::samples_follow_pdf(
      [&](Rng& rng) -> std::optional<test::DirectionSample> {
        const std::optional<ShapeSample> s = shape().sample_toward(from(), rng.next_vec2());
        if (!s) return std::nullopt;
        return test::DirectionSample{.d = glm::normalize(s->p - from()), .pdf = s->pdf};
      },
      [&](const Vec3& d) {
        const std::optional<Hit> hit = queries.intersect({from(), d}, kInfinity);
        return hit ? shape().pdf_toward(from(), *hit) : 0.0f;
      },
      settings));
}

TEST_P(Sampling, HasTheSolidAngleOfTheShape) {
  const RayQueries queries = test::queries(GetParam().shape);
  Rng rng(2);
  test::RunningMean sampled, seen, density;
  for (int i = 0; i < 200000; ++i) {
    const std::optional<ShapeSample> s = shape().sample_toward(from(), rng.next_vec2());
    sampled.add(s ? 1.0 / s->pdf : 0.0);
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    const std::optional<Hit> hit = queries.intersect({from(), d}, kInfinity);
    seen.add(hit ? 4.0 * M_PI : 0.0);
    density.add(hit ? 4.0 * M_PI * shape().pdf_toward(from(), *hit) : 0.0);
  }
  EXPECT_TRUE(test::agree(sampled, seen)) << "mean of 1 / pdf";
  EXPECT_TRUE(test::agrees(density, 1.0)) << "integral of pdf";
}

INSTANTIATE_TEST_SUITE_P(Views, Sampling, ::testing::ValuesIn(views()),
                         [](const auto& view) { return view.param.name; });

TEST(SphereSampling, IsAccurateFromAnyDistance) {
  Rng rng(4);
  for (const float distance : {1.0001f, 2.0f, 1e3f, 1e6f, 1e12f}) {
    const Sphere sphere(Vec3(0.0f, 0.0f, 0.0f), 1.0f, false);
    const Vec3 from(0.0f, 0.0f, distance);
    const double sine = 1.0 / double(distance);
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const double solid_angle = 2.0 * M_PI * sine * sine / (1.0 + cosine);
    test::RunningMean height;  // uniform over the cone, 1 - cos is uniform
    for (int i = 0; i < 20000; ++i) {
      const std::optional<ShapeSample> s = sphere.sample_toward(from, rng.next_vec2());
      ASSERT_TRUE(s);
      ASSERT_NEAR(s->pdf * solid_angle, 1.0, 1e-6);
      ASSERT_NEAR(glm::length(s->p), 1.0f, 2e-7f);
      ASSERT_GE(s->p.z, sine - 1e-6) << "on the far side";
      const double x = s->p.x, y = s->p.y, z = double(distance) - s->p.z;
      const double lateral2 = x * x + y * y;
      const double sin2 = lateral2 / (lateral2 + z * z);
      height.add(sin2 / (1.0 + std::sqrt(1.0 - sin2)) / (sine * sine / (1.0 + cosine)));
    }
    EXPECT_TRUE(test::agrees(height, 0.5, 1e-6)) << distance;
  }
}

TEST(Area, IsTheAverageSilhouetteOfAConvexShape) {
  // Cauchy: the mean area of the projections is a quarter of the surface, so that of the lines
  // through a ball of radius R, uniform in direction and offset, the fraction A / (4 pi R^2) hits.
  constexpr float kRadius = 3.0f;
  for (const test::ShapePtr& shape : std::vector<test::ShapePtr>{
           std::make_shared<Sphere>(Vec3(0.0f, 0.0f, 0.0f), 1.2f, false),
           std::make_shared<Cube>(test::skewed(), false),
           std::make_shared<TriangleMesh>(test::sphere_mesh(2), test::skewed(), false, false)}) {
    const RayQueries queries = test::queries(shape);
    Rng rng(5);
    test::RunningMean area;
    for (int i = 0; i < 400000; ++i) {
      const Frame frame(sample_uniform_sphere(rng.next_vec2()));
      const Vec2 offset = kRadius * sample_disk(rng.next_vec2());
      const Vec3 o = frame.to_world(Vec3(offset.x, offset.y, -10.0f));
      area.add(test::is_occluded(queries, {o, frame.n}, kInfinity) ? 4.0 * M_PI * kRadius * kRadius
                                                                   : 0.0);
    }
    EXPECT_TRUE(test::agrees(area, shape->area()));
  }
}

TEST(Area, OfFlatShapesIsThatOfTheirOutline) {
  // Seen along the normal: the fraction of rays through a square of 4 x 4.
  const glm::dmat4 flat =
      glm::dmat4(glm::dvec4(1.0, 0.5, 0.0, 0.0), glm::dvec4(-0.2, 0.7, 0.0, 0.0),
                 glm::dvec4(0.0, 0.0, 1.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
  for (const test::ShapePtr& shape : std::vector<test::ShapePtr>{
           std::make_shared<Rectangle>(flat, false), std::make_shared<Disk>(flat, false)}) {
    const RayQueries queries = test::queries(shape);
    Rng rng(6);
    test::RunningMean area;
    for (int i = 0; i < 200000; ++i) {
      const Vec2 xy = 4.0f * rng.next_vec2() - 2.0f;
      area.add(test::is_occluded(queries, {{xy.x, xy.y, 1.0f}, {0, 0, -1}}, kInfinity) ? 16.0
                                                                                       : 0.0);
    }
    EXPECT_TRUE(test::agrees(area, shape->area()));
  }
}

}  // namespace
}  // namespace brume
