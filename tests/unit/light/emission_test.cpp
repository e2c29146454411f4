// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/rng.h"
#include "core/warp.h"
#include "geometry/ray_queries.h"
#include "light/area_light.h"
#include "light/constant_environment.h"
#include "light/directional_light.h"
#include "light/distant_disk_light.h"
#include "light/point_light.h"
#include "light/spot_light.h"
#include "support/statistics.h"
#include "unit/geometry/shapes.h"

namespace brume {
namespace {

const Rgb kEmission{1.0f, 2.0f, 4.0f};

/// A lamp, and a target around it that catches its light: the part of a sphere around the lamp
/// within an angle of `axis`.
struct Lamp {
  std::string name;
  std::shared_ptr<const Light> light;
  double power;  // for a unit of emission [W]
  Vec3 axis{0.0f, 0.0f, 1.0f};
  float one_minus_cos = 2.0f;  // of the angle of the target; all of the light arrives within
};

constexpr float kTargetRadius = 3.0f;
const Vec3 kPlace{0.7f, -0.4f, 0.2f};

/// 1 - cos of an angle, for small ones too.
float versine(double angle) {
  return static_cast<float>(2.0 * std::sin(0.5 * angle) * std::sin(0.5 * angle));
}

/// Integral of the falloff over the sphere.
double spot_power(double cutoff, double beam) {
  const double mean_cosine =
      cutoff > beam ? (std::sin(cutoff) - std::sin(beam)) / (cutoff - beam) : std::cos(cutoff);
  return 2.0 * M_PI * (1.0 - mean_cosine);
}

/// `linear`, and a place near the center of the target.
glm::dmat4 at_place(const glm::dmat4& linear) {
  return glm::translate(glm::dmat4(1.0), glm::dvec3(kPlace)) * linear;
}

Lamp spot(const std::string& name, const glm::dmat4& similarity, float cutoff, float beam) {
  return {.name = name,
          .light = std::make_shared<SpotLight>(similarity, kEmission, cutoff, beam),
          .power = spot_power(cutoff, beam),
          .axis = Vec3(glm::normalize(glm::dvec3(similarity[2]))),
          .one_minus_cos = versine(std::min(1.1 * double(cutoff), M_PI))};
}

Lamp area_lamp(const std::string& name, const test::ShapePtr& shape) {
  return {.name = name,
          .light = std::make_shared<AreaLight>(shape, kEmission),
          .power = M_PI * shape->area()};
}

std::vector<Lamp> convex_lamps() {
  const glm::dmat4 center = test::placed(20.0, Vec3d(0.0));
  const glm::dmat4 tilted = test::placed(0.8, Vec3d(kPlace));
  const glm::dmat4 skewed = at_place(test::skewed());
  return {
      {.name = "Point",
       .light = std::make_shared<PointLight>(kPlace, kEmission),
       .power = 4.0 * M_PI},
      spot("Spot", center, 0.6f, 0.2f),
      spot("MirroredSpot", center * test::mirrored(), 0.6f, 0.2f),
      spot("HardSpot", center, 0.3f, 0.3f),
      spot("NarrowSpot", center, 1e-3f, 0.4e-3f),
      spot("SpotAllAround", center, kPi, 0.0f),
      area_lamp("Rectangle", std::make_shared<Rectangle>(tilted, false)),
      area_lamp("SkewedRectangleTurned", std::make_shared<Rectangle>(skewed, true)),
      area_lamp("Disk", std::make_shared<Disk>(skewed, false)),
      area_lamp("Sphere", std::make_shared<Sphere>(kPlace, 0.9f, false)),
      area_lamp("Cube", std::make_shared<Cube>(skewed, false)),
      area_lamp("Mesh", std::make_shared<TriangleMesh>(test::sphere_mesh(0), skewed, true, false)),
  };
}

/// Integral of what arrives at distance 1 from `position`, by the midpoint rule.
double power_by_quadrature(const Light& light, const Vec3& position) {
  constexpr int kResolution = 300;
  const double step = M_PI / kResolution;
  double sum = 0.0;
  for (int i = 0; i < kResolution; ++i) {
    const double theta = (i + 0.5) * step;
    for (int j = 0; j < 2 * kResolution; ++j) {
      const Vec3 d = spherical_direction(float(std::sin(theta)), float(std::cos(theta)),
                                         float((j + 0.5) * step));
      const auto s = light.sample(position + d, {0.5f, 0.5f});
      if (s) sum += std::sin(theta) * double(s->weight.r);
    }
  }
  return sum * step * step;
}

/// Spots that are not round in the world.
std::vector<Lamp> skewed_spots() {
  const auto skewed_spot = [](const std::string& name, const glm::dmat4& linear, float cutoff) {
    const auto light =
        std::make_shared<SpotLight>(at_place(linear), kEmission, cutoff, 0.3f * cutoff);
    return Lamp{.name = name, .light = light, .power = power_by_quadrature(*light, kPlace)};
  };
  const glm::dmat4 flat = glm::scale(test::placed(3.0, Vec3d(0.0)), Vec3d(1.0, 1.0, 0.3));
  return {skewed_spot("SkewedSpot", test::skewed(), 0.9f), skewed_spot("FlatSpot", flat, 2.0f),
          skewed_spot("MirroredSkewedSpot", test::skewed() * test::mirrored(), 0.9f)};
}

std::vector<Lamp> all_lamps() {
  std::vector<Lamp> lamps = convex_lamps();
  for (Lamp& lamp : skewed_spots()) lamps.push_back(lamp);
  const glm::dmat4 skewed = at_place(test::skewed());
  const Similarity tilted = *as_similarity(test::placed(0.8, Vec3d(kPlace)));
  for (const bool flip : {false, true})
    lamps.push_back(
        area_lamp(flip ? "TubeInsideOut" : "Tube",
                  std::make_shared<Cylinder>(Vec3(0, 0, -1), Vec3(0, 0, 1), 0.5f, tilted, flip)));
  lamps.push_back(area_lamp("SphereInsideOut", std::make_shared<Sphere>(kPlace, 0.9f, true)));
  lamps.push_back(area_lamp("CubeInsideOut", std::make_shared<Cube>(skewed, true)));
  return lamps;
}

std::string name_of(const ::testing::TestParamInfo<Lamp>& info) {
  return info.param.name;
}

using Emission = ::testing::TestWithParam<Lamp>;

TEST_P(Emission, AlwaysIsAFiniteRay) {
  Rng rng(1);
  const std::array<float, 4> edge{0.0f, 0.5f, 0x1p-24f, kOneMinusEpsilon};
  for (int i = 0; i < 20000; ++i) {
    Vec2 u_point = rng.next_vec2(), u_direction = rng.next_vec2();
    if (i < 256) {
      u_point = {edge[i % 4], edge[i / 4 % 4]};
      u_direction = {edge[i / 16 % 4], edge[i / 64]};
    }
    const auto emitted = GetParam().light->emit(u_point, u_direction);
    ASSERT_TRUE(emitted);
    ASSERT_NEAR(glm::length(emitted->ray.d), 1.0f, 1e-6f);
    ASSERT_LT(glm::length(emitted->ray.o), kTargetRadius);
    ASSERT_TRUE(is_finite_and_non_negative(emitted->power));
  }
}

TEST_P(Emission, HasThePowerOfTheLightOnAverage) {
  Rng rng(2);
  std::array<test::RunningMean, 3> power;
  for (int i = 0; i < 100000; ++i) {
    const Vec2 u_point = rng.next_vec2();
    const auto emitted = GetParam().light->emit(u_point, rng.next_vec2());
    for (int c = 0; c < 3; ++c) power[c].add(emitted->power[c]);
  }
  for (int c = 0; c < 3; ++c) {
    const double want = GetParam().power * double(kEmission[c]);
    EXPECT_TRUE(test::agrees(power[c], want, 1e-6 * want));
  }
}

INSTANTIATE_TEST_SUITE_P(Lamps, Emission, ::testing::ValuesIn(all_lamps()), name_of);

/// The target, in parts of equal area.
class Target {
 public:
  explicit Target(const Lamp& lamp) : frame_(lamp.axis), one_minus_cos_(lamp.one_minus_cos) {}

  static constexpr int kRings = 6, kSectors = 8, kParts = kRings * kSectors;

  double area() const {
    return 2.0 * M_PI * double(kTargetRadius * kTargetRadius * one_minus_cos_);
  }

  /// Outward normal at a point uniform over the target.
  Vec3 sample(const Vec2& u) const {
    const float v = u.x * one_minus_cos_;
    return frame_.to_world(
        spherical_direction(std::sqrt(v * (2.0f - v)), 1.0f - v, 2.0f * kPi * u.y));
  }

  /// Part of the point with the outward normal `n`; kParts for one outside the target.
  int part(const Vec3& n) const {
    const float ring = one_minus_cos(n, frame_.n) / one_minus_cos_;
    if (!(ring < 1.0f)) return kParts;
    const Vec3 local = frame_.to_local(n);
    const float turn = 0.5f + std::atan2(local.y, local.x) / (2.0f * kPi);
    return int(ring * kRings) * kSectors + std::min(int(turn * kSectors), kSectors - 1);
  }

 private:
  Frame frame_;
  float one_minus_cos_;
};

/// Outward normal where a ray from inside meets the sphere of the target.
Vec3 exit_normal(const Ray& ray) {
  const Vec3d o(ray.o), d(ray.d);
  return Vec3(glm::normalize(o + crossings_of_ball(o, d, double(kTargetRadius))->second * d));
}

using LightLeaving = ::testing::TestWithParam<Lamp>;

TEST_P(LightLeaving, ArrivesAsItIsSampledThere) {
  const Light& light = *GetParam().light;
  const Target target(GetParam());
  // Flux through the parts of the target, one channel.
  std::array<test::RunningMean, Target::kParts + 1> emitted, sampled;
  Rng rng(3);
  for (int i = 0; i < 300000; ++i) {
    const Vec2 u_point = rng.next_vec2();
    const auto ray = light.emit(u_point, rng.next_vec2());
    const int part_hit = target.part(exit_normal(ray->ray));

    const Vec3 n = target.sample(rng.next_vec2());
    const auto s = light.sample(kTargetRadius * n, rng.next_vec2());
    const double flux = s ? -glm::dot(s->d, n) * s->weight.g * target.area() : 0.0;
    ASSERT_GE(flux, 0.0);
    const int part_lit = target.part(n);

    for (int part = 0; part <= Target::kParts; ++part) {
      emitted[part].add(part == part_hit ? double(ray->power.g) : 0.0);
      sampled[part].add(part == part_lit ? flux : 0.0);
    }
  }
  for (int part = 0; part < Target::kParts; ++part)
    EXPECT_TRUE(test::agree(emitted[part], sampled[part])) << "part " << part;
  EXPECT_EQ(emitted[Target::kParts].mean(), 0.0) << "beside the target";
}

std::vector<Lamp> lamps_that_do_not_hide_themselves() {
  std::vector<Lamp> lamps = convex_lamps();
  for (Lamp& lamp : skewed_spots()) lamps.push_back(lamp);
  return lamps;
}

INSTANTIATE_TEST_SUITE_P(Lamps, LightLeaving,
                         ::testing::ValuesIn(lamps_that_do_not_hide_themselves()), name_of);

struct Placement {
  double size;
  double offset;  // from the origin, in sizes
};

class EmittedRays : public ::testing::TestWithParam<Placement> {};

TEST_P(EmittedRays, LeaveALampAndShowItWhenLookedBackAlong) {
  const auto [size, offset] = GetParam();
  const Vec3d center = size * offset * Vec3d(1.0, -0.7, 0.4);
  const glm::dmat4 to_world = test::placed(size, center);
  for (const test::ShapePtr& shape : std::vector<test::ShapePtr>{
           std::make_shared<Rectangle>(to_world, false), std::make_shared<Disk>(to_world, true),
           std::make_shared<Sphere>(Vec3(center), float(size), false),
           std::make_shared<Cube>(to_world * test::skewed(), false),
           std::make_shared<TriangleMesh>(test::sphere_mesh(0), to_world, true, false)}) {
    const AreaLight light(shape, kEmission);
    const RayQueries queries = test::queries(shape);
    Rng rng(4);
    int seen = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec2 u_point = rng.next_vec2();
      const auto emitted = light.emit(u_point, rng.next_vec2());
      ASSERT_FALSE(queries.intersect(emitted->ray, kInfinity));
      const Ray back{.o = emitted->ray.at(float(size)), .d = -emitted->ray.d};
      const auto hit = queries.intersect(back, kInfinity);
      if (hit && light.radiance(*hit, back.d) == kEmission) ++seen;
    }
    EXPECT_GT(seen, 19900);  // all but those that rounding carries past the edge
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, EmittedRays,
                         ::testing::Values(Placement{1e-6, 0.0}, Placement{1.0, 0.0},
                                           Placement{1e12, 0.0}, Placement{1e-6, 1e3},
                                           Placement{1.0, 1e3}, Placement{1e12, 1e3}));

TEST(LightFromInfinitelyFarAway, DoesNotSetOutAnywhere) {
  const std::vector<std::shared_ptr<const Light>> lights{
      std::make_shared<DirectionalLight>(Vec3(0, -1, 0), kEmission),
      std::make_shared<DistantDiskLight>(Vec3(0, -1, 0), 0.1f, kEmission),
      std::make_shared<ConstantEnvironment>(kEmission)};
  Rng rng(5);
  for (const auto& light : lights) {
    for (int i = 0; i < 100; ++i) {
      const Vec2 u_point = rng.next_vec2();
      EXPECT_FALSE(light->emit(u_point, rng.next_vec2()));
    }
  }
}

}  // namespace
}  // namespace brume
