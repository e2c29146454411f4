// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_paths.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/statistics.h"
#include "unit/integrator/lit_scenes.h"

namespace brume::test {
namespace {

using Lanes = LightPathSet::Lanes;

constexpr int kUnlimited = std::numeric_limits<int>::max();

/// Light paths with all that they refer to.
struct Lit {
  explicit Lit(const std::string& body)
      : test_scene(lit_scene(body)),
        scene(*test_scene.loaded().scene),
        camera_medium(scene, *test_scene.loaded().camera),
        light_paths(scene, *test_scene.loaded().camera, camera_medium, kUnlimited) {}

  TestScene test_scene;
  const Scene& scene;
  CameraMedium camera_medium;
  LightPaths light_paths;
};

const auto kAlike = [](const Lanes&, const Lanes&, const Lanes&) {
  return LightPathSet::Seen{Lanes(1.0f), Lanes(1.0f)};
};

TEST(LightPaths, ShareLightWithPathsFromTheCameraWithoutRest) {
  const Lit lit(kFoggyRoom);
  ASSERT_TRUE(lit.light_paths.exist());
  for (int i = -12; i <= 12; ++i)
    for (int k = -12; k <= 12; ++k) {
      const auto distance = float(std::pow(10.0, i)), pdf = float(std::pow(10.0, k));
      const double of_camera = lit.light_paths.camera_share(distance, pdf);
      const double of_light = double(distance) * distance *
                              double(lit.light_paths.reach_squared()) *
                              double(lit.light_paths.light_share(distance, pdf));
      EXPECT_NEAR(of_camera + of_light, 1.0, 1e-6) << distance << ", " << pdf;
      EXPECT_GE(of_camera, 0.0);
      EXPECT_GE(of_light, 0.0);
    }
}

TEST(LightPaths, ExistWhereLampsLightAClosedRoom) {
  EXPECT_TRUE(Lit(kFoggyRoom).light_paths.exist());
  EXPECT_TRUE(Lit(kRoom + kAreaLamp).light_paths.exist());
}

TEST(LightPaths, DoNotExistWhereALampStandsInFogWithoutEnd) {
  EXPECT_FALSE(Lit(world_fog("0.5, 0.5, 0.5", "0.9, 0.9, 0.9") + point_lamp("0, 0, 0", "1, 1, 1"))
                   .light_paths.exist());
}

TEST(LightPaths, DoNotExistWhereBoundariesContradictEachOther) {
  const auto ball = [](const std::string& exterior) {
    return "<medium type=\"homogeneous\" id=\"fog\"><float name=\"sigma_t\" "
           "value=\"0.4\"/></medium>"
           "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"1.9\"/></transform>"
           "<bsdf type=\"null\"/><ref name=\"interior\" id=\"fog\"/></shape>"
           "<shape type=\"sphere\"><float name=\"radius\" value=\"0.5\"/><bsdf "
           "type=\"dielectric\"/>"
           "<medium type=\"homogeneous\" name=\"interior\"/>" +
           exterior + "</shape>";
  };
  const std::string lit = kRoom + point_lamp("1, 1, 1", "1, 1, 1");
  EXPECT_TRUE(Lit(lit + ball("<ref name=\"exterior\" id=\"fog\"/>")).light_paths.exist());
  EXPECT_FALSE(Lit(lit + ball("")).light_paths.exist());
}

TEST(LightPaths, DoNotExistWithAnEnvironment) {
  EXPECT_FALSE(Lit(kRoom + kAreaLamp +
                   "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>")
                   .light_paths.exist());
}

TEST(LightPaths, DoNotExistWithADirectionalLight) {
  EXPECT_FALSE(Lit(kRoom + kAreaLamp +
                   "<emitter type=\"directional\"><vector name=\"direction\" value=\"0, -1, 0\"/>"
                   "<rgb name=\"irradiance\" value=\"1\"/></emitter>")
                   .light_paths.exist());
}

TEST(LightPaths, DoNotExistInTheDark) {
  EXPECT_FALSE(Lit(kRoom + world_fog("1, 1, 1", "1, 1, 1")).light_paths.exist());
}

/// What is chosen from all bundles of a set at several places.
std::vector<float> fingerprint(const LightPathSet& set) {
  std::vector<float> result;
  for (std::uint32_t bundle = 0; bundle < Sampler::kBlock; ++bundle)
    for (const Vec3& p : {Vec3(0.0f), Vec3(1.0f, -1.0f, 0.5f)})
      for (const float u : {0.1f, 0.5f, 0.9f})
        if (const auto choice = set.choose(bundle, p, kUnlimited, kAlike, u)) {
          const Vec3 q = choice->vertex->p;
          result.insert(result.end(), {q.x, q.y, q.z, choice->weight});
        }
  return result;
}

TEST(LightPaths, AreAFunctionOfSeedAndGroup) {
  const Lit lit(kFoggyRoom), again(kFoggyRoom);
  const LightPaths& paths = lit.light_paths;
  const std::vector<float> first = fingerprint(*paths.of({11, 3}));
  EXPECT_GT(first.size(), 100u);
  EXPECT_EQ(fingerprint(*paths.of({11, 3})), first);
  // Others push it out of where it was kept.
  EXPECT_NE(fingerprint(*paths.of({12, 3})), first);
  EXPECT_NE(fingerprint(*paths.of({11, 4})), first);
  EXPECT_NE(fingerprint(*paths.of({11, 3 + LightPaths::kGroups})), first);
  EXPECT_EQ(fingerprint(*paths.of({11, 3})), first);
  EXPECT_EQ(fingerprint(*again.light_paths.of({11, 3})), first);
}

TEST(LightPaths, DifferInEveryBundleOfASet) {
  const Lit lit(kFoggyRoom);
  const auto set = lit.light_paths.of({11, 3});
  const auto choice = [&](std::uint32_t bundle) {
    return set->choose(bundle, Vec3(0.0f), kUnlimited, kAlike, 0.5f)->vertex->p;
  };
  for (std::uint32_t bundle = 1; bundle < Sampler::kBlock; ++bundle)
    EXPECT_NE(choice(bundle), choice(0));
}

/// Guiding, keeping and choosing leave what light paths stand for: the power that arrives in each
/// eighth of the room is the one that unguided paths bring there. From the middle of an empty
/// convex room all of it is in sight.
TEST(LightPaths, StandForAllLightThatArrives) {
  const Lit lit(world_fog("0.3, 0.4, 0.5", "0.95, 0.9, 0.8") + kRoom + kSpotLamp +
                point_lamp("1, 0.5, 1", "3, 2, 1"));
  ASSERT_TRUE(lit.light_paths.exist());
  const auto part = [](const LightVertex& vertex) {
    const Vec3 p = vertex.p;
    return std::size_t((p.x > 0.0f ? 1 : 0) + (p.y > 0.0f ? 2 : 0) + (p.z > 0.0f ? 4 : 0) +
                       (vertex.hit ? 8 : 0));
  };
  constexpr std::size_t kParts = 16;

  std::array<RunningMean, kParts> unguided, chosen;
  const LightTracer tracer(lit.scene, kUnlimited);
  std::vector<LightVertex> vertices;
  for (std::uint32_t i = 0; i < 60000; ++i) {
    vertices.clear();
    for (std::size_t lamp = 0; lamp < tracer.lamps().size(); ++lamp) {
      Sampler sampler(3 + lamp, i, 0, true);
      const Vec2 u_direction = sampler.next_2d();
      tracer.trace(tracer.lamps()[lamp], u_direction, 1.0f, sampler, vertices);
    }
    std::array<double, kParts> sums{};
    for (const LightVertex& vertex : vertices) sums[part(vertex)] += luminance(vertex.power);
    for (std::size_t k = 0; k < kParts; ++k) unguided[k].add(sums[k]);
  }

  Rng rng(1);
  constexpr std::uint32_t kChoices = 64;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto set = lit.light_paths.of({seed, 0});
    std::array<double, kParts> sums{};
    for (std::uint32_t bundle = 0; bundle < Sampler::kBlock; ++bundle)
      for (std::uint32_t i = 0; i < kChoices; ++i) {
        const float u = (float(i) + rng.next_float()) / kChoices;
        const auto choice = set->choose(bundle, Vec3(0.0f), kUnlimited, kAlike, u);
        if (choice)
          sums[part(*choice->vertex)] += double(choice->weight) * luminance(choice->vertex->power) /
                                         (Sampler::kBlock * kChoices);
      }
    for (std::size_t k = 0; k < kParts; ++k) chosen[k].add(sums[k]);
  }
  for (std::size_t k = 0; k < kParts; ++k) {
    EXPECT_TRUE(agree(chosen[k], unguided[k])) << "part " << k;
    EXPECT_LT(chosen[k].standard_error(), 0.05 * chosen[k].mean()) << "part " << k;
  }
}

}  // namespace
}  // namespace brume::test
