// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "core/frame.h"
#include "core/rng.h"
#include "shapes.h"
#include "support/statistics.h"

namespace brume {
namespace {

struct NamedShape {
  std::string name;
  test::ShapePtr shape;
};

std::vector<NamedShape> shapes() {
  const Vec3d offset(3.0, -2.0, 5.0);
  const glm::dmat4 placed = test::placed(1.5, offset);
  const glm::dmat4 skewed = test::placed(0.8, offset) * test::skewed();
  const glm::dmat4 uneven = glm::scale(placed, Vec3d(1.0, 0.3, 2.0));
  const auto tube = [&](bool flip) {
    return std::make_shared<Cylinder>(Vec3(0, 0, -1), Vec3(0.5f, 0, 2), 0.7f,
                                      *as_similarity(placed), flip);
  };
  const auto mesh = [&](bool flip) {
    return std::make_shared<TriangleMesh>(test::sphere_mesh(1), skewed, true, flip);
  };
  return {{"Sphere", std::make_shared<Sphere>(Vec3(offset), 1.5f, false)},
          {"SphereInsideOut", std::make_shared<Sphere>(Vec3(offset), 1.5f, true)},
          {"Rectangle", std::make_shared<Rectangle>(uneven, false)},
          {"SkewedRectangle", std::make_shared<Rectangle>(skewed, true)},
          {"Disk", std::make_shared<Disk>(placed, false)},
          {"SkewedDisk", std::make_shared<Disk>(skewed, true)},
          {"UnevenCube", std::make_shared<Cube>(uneven, false)},
          {"SkewedCube", std::make_shared<Cube>(skewed, false)},
          {"MirroredCubeInsideOut", std::make_shared<Cube>(uneven * test::mirrored(), true)},
          {"Cylinder", tube(false)},
          {"CylinderInsideOut", tube(true)},
          {"Mesh", mesh(false)},
          {"MeshInsideOut", mesh(true)}};
}

class AreaSampling : public ::testing::TestWithParam<NamedShape> {
 protected:
  const Shape& shape() const { return *GetParam().shape; }
};

TEST_P(AreaSampling, PointsAreThoseThatRaysFind) {
  constexpr double kAway = 1e-4;
  constexpr int kPoints = 20000;
  Rng rng(1);
  int found = 0;
  for (int i = 0; i < kPoints; ++i) {
    const SurfacePoint point = shape().sample_area(rng.next_vec2());
    ASSERT_NEAR(glm::length(point.n), 1.0f, 1e-6f);
    const Vec3d n(point.n);
    const PreciseRay ray{.o = Vec3d(point.p) + kAway * n, .d = -n};
    const std::optional<Crossing> crossing = shape().intersect(ray, 2.0 * kAway);
    if (!crossing) continue;
    const Hit hit = shape().hit(ray, *crossing);
    const bool is_here = std::abs(crossing->t - kAway) <= 2.0 * point.error &&
                         glm::length(hit.p - point.p) <= 8.0f * point.error;
    if (!is_here) continue;
    ++found;
    ASSERT_GT(glm::dot(hit.n, point.n), 1.0f - 1e-6f);
    ASSERT_NEAR(hit.error / point.error, 1.0f, 1e-3f);
  }
  EXPECT_GT(found, 0.998 * kPoints);  // all but those at the very edge
}

/// What a point adds to integrals over the shape: its part of the shape's bounds, and its normal.
class Features {
 public:
  explicit Features(const Box3& bounds) : bounds_(bounds) {}

  static constexpr int kParts = 3;  // along each axis
  static constexpr int kCount = kParts * kParts * kParts + 3;
  using Sums = std::array<double, kCount>;

  void add(Sums& sums, const Vec3& p, const Vec3& n, double weight) const {
    const Vec3 x = (p - bounds_.min) / bounds_.size();
    int part = 0;
    for (int i = 0; i < 3; ++i)
      part = part * kParts + std::clamp(int(float(kParts) * x[i]), 0, kParts - 1);
    sums[part] += weight;
    for (int i = 0; i < 3; ++i) sums[kCount - 3 + i] += weight * double(n[i]);
  }

 private:
  Box3 bounds_;
};

TEST_P(AreaSampling, IsUniformAsTheCrossingsOfRandomLines) {
  // Cauchy and Crofton: lines through a ball of radius R, uniform in direction and offset, cross
  // every patch of area A inside it A / (2 pi R^2) times on average, however it lies.
  const RayQueries queries = test::queries(GetParam().shape);
  const Box3 bounds = shape().bounds();
  const Features features(bounds);
  const float R = 0.5f * glm::length(bounds.size());
  std::array<test::RunningMean, Features::kCount> by_area, by_lines;
  Rng rng(2);
  for (int i = 0; i < 200000; ++i) {
    Features::Sums sums{};
    const SurfacePoint point = shape().sample_area(rng.next_vec2());
    features.add(sums, point.p, point.n, shape().area());
    for (int k = 0; k < Features::kCount; ++k) by_area[k].add(sums[k]);

    sums = {};
    const Frame frame(sample_uniform_sphere(rng.next_vec2()));
    const Vec2 offset = R * sample_disk(rng.next_vec2());
    const Vec3 start = bounds.center() + frame.to_world({offset.x, offset.y, -2.0f * R});
    std::optional<Hit> hit = queries.intersect({start, frame.n}, kInfinity);
    for (; hit; hit = queries.intersect(hit->leave(frame.n), kInfinity))
      features.add(sums, hit->p, hit->n, 2.0 * M_PI * R * R);
    for (int k = 0; k < Features::kCount; ++k) by_lines[k].add(sums[k]);
  }
  for (int k = 0; k < Features::kCount; ++k)
    EXPECT_TRUE(test::agree(by_area[k], by_lines[k], 1e-6 * shape().area())) << "feature " << k;
}

TEST_P(AreaSampling, RaysThatLeaveAPointStartOnTheirSide) {
  Rng rng(3);
  for (int i = 0; i < 20000; ++i) {
    const SurfacePoint point = shape().sample_area(rng.next_vec2());
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    const Ray ray = point.leave(d);
    ASSERT_EQ(ray.d, d);
    const Vec3 step = ray.o - point.p;
    ASSERT_GT(glm::dot(step, point.n) * glm::dot(d, point.n), 0.0f);
    ASSERT_LE(glm::length(step), 2.0f * point.error);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, AreaSampling, ::testing::ValuesIn(shapes()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace brume
