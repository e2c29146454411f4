// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_path_guide.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/statistics.h"
#include "unit/integrator/lit_scenes.h"

namespace brume::test {
namespace {

/// A guide with all that it refers to.
struct Guided {
  explicit Guided(const std::string& body)
      : scene(lit_scene(body)),
        tracer(*scene.loaded().scene, std::numeric_limits<int>::max()),
        camera_medium(*scene.loaded().scene, *scene.loaded().camera),
        receivers(
            find_receivers(*scene.loaded().scene, *scene.loaded().camera, camera_medium, 256)),
        guide(*scene.loaded().scene, tracer, receivers) {}

  TestScene scene;
  LightTracer tracer;
  CameraMedium camera_medium;
  std::vector<Receiver> receivers;
  LightPathGuide guide;
};

/// One over the density of a choice is 1 on average over any part of what may be chosen that has
/// the size 1.
TEST(LightPathGuide, ChoosesLampsAndDirectionsWithTheDensityItStates) {
  const Guided guided(kFoggyRoom);
  ASSERT_EQ(guided.tracer.lamps().size(), 3u);
  ASSERT_TRUE(guided.guide.found_light());
  // [lamp][quarter of the square of u_direction]
  std::vector<std::array<RunningMean, 4>> quarters(3);
  for (int i = 0; i < 200000; ++i) {
    Sampler sampler(1, std::uint32_t(i), 0, true);
    const LightPathGuide::Start start = guided.guide.start(sampler);
    const Vec2 u = start.u_direction;
    ASSERT_TRUE(u.x >= 0.0f && u.x < 1.0f && u.y >= 0.0f && u.y < 1.0f);
    const std::size_t here = (u.x < 0.5f ? 0 : 1) + (u.y < 0.5f ? 0 : 2);
    for (std::size_t lamp = 0; lamp < 3; ++lamp)
      for (std::size_t quarter = 0; quarter < 4; ++quarter)
        quarters[lamp][quarter].add(lamp == start.lamp && quarter == here ? double(start.weight)
                                                                          : 0.0);
  }
  for (std::size_t lamp = 0; lamp < 3; ++lamp)
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      const RunningMean& share = quarters[lamp][quarter];
      EXPECT_TRUE(agrees(share, 0.25)) << "lamp " << lamp << ", quarter " << quarter;
      EXPECT_LT(share.standard_error(), 0.01);
    }
}

TEST(LightPathGuide, MayKeepEveryPlace) {
  const Guided guided(kFoggyRoom);
  std::vector<LightVertex> vertices;
  for (std::uint32_t i = 0; i < 500; ++i) {
    Sampler sampler(2, i, 0, true);
    guided.tracer.trace(guided.tracer.lamps()[i % 3], sampler.next_2d(), 1.0f, sampler, vertices);
  }
  ASSERT_GT(vertices.size(), 1000u);
  for (const LightVertex& vertex : vertices) {
    EXPECT_GT(guided.guide.keep(vertex), 0.0f);
    EXPECT_LE(guided.guide.keep(vertex), 1.0f);
  }
}

TEST(LightPathGuide, FindsNoLightBehindAWall) {
  const Guided guided(kRoom + point_lamp("0, 0, 0", "1, 1, 1") + R"(
    <shape type="sphere"><float name="radius" value="0.5"/>
      <bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>)");
  EXPECT_FALSE(guided.guide.found_light());
}

}  // namespace
}  // namespace brume::test
