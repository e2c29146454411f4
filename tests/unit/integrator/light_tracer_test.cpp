// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_tracer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "support/statistics.h"
#include "unit/integrator/lit_scenes.h"

namespace brume::test {
namespace {

constexpr int kUnlimited = std::numeric_limits<int>::max();

/// What light brings to places that `counts`, all lamps together, a channel at a time [W].
std::array<RunningMean, 3> arriving_power(const Scene& scene, int max_scatterings, int paths,
                                          const std::function<bool(const LightVertex&)>& counts) {
  const LightTracer tracer(scene, max_scatterings);
  std::array<RunningMean, 3> result;
  std::vector<LightVertex> vertices;
  for (int i = 0; i < paths; ++i) {
    glm::dvec3 sum(0.0);
    vertices.clear();
    for (std::size_t lamp = 0; lamp < tracer.lamps().size(); ++lamp) {
      Sampler sampler(7 + lamp, std::uint32_t(i), 0, true);
      const Vec2 u_direction = sampler.next_2d();
      tracer.trace(tracer.lamps()[lamp], u_direction, 1.0f, sampler, vertices);
    }
    for (const LightVertex& vertex : vertices)
      if (counts(vertex)) sum += glm::dvec3(vertex.power);
    for (int c = 0; c < 3; ++c) result[std::size_t(c)].add(sum[c]);
  }
  return result;
}

void expect_power(const std::array<RunningMean, 3>& got, const glm::dvec3& want) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(agrees(got[std::size_t(c)], want[c], 1e-5 * want[c])) << "channel " << c;
    EXPECT_LT(got[std::size_t(c)].standard_error(), 0.02 * want[c]) << "channel " << c;
  }
}

/// The largest number of scatterings after which any light arrives.
int most_scatterings(const Scene& scene, int max_scatterings, int paths) {
  int most = 0;
  arriving_power(scene, max_scatterings, paths, [&](const LightVertex& vertex) {
    most = std::max(most, vertex.scatterings);
    return true;
  });
  return most;
}

bool is_first(const LightVertex& vertex) {
  return vertex.scatterings == 1;
}
bool is_first_on_a_surface(const LightVertex& vertex) {
  return is_first(vertex) && vertex.hit.has_value();
}
bool is_first_in_a_medium(const LightVertex& vertex) {
  return is_first(vertex) && !vertex.hit;
}

/// A disk of radius 2 below a lamp at (0, 1.5, 0).
const std::string kFloor = R"(
  <shape type="disk">
    <transform name="to_world"><scale value="2"/><rotate x="1" angle="-90"/></transform>
    <bsdf type="diffuse"/>
  </shape>)";
constexpr double kHeight = 1.5, kFloorRadius = 2.0;
const std::string kLampAboveFloor = point_lamp("0, 1.5, 0", "9, 8, 7");
const glm::dvec3 kIntensity(9.0, 8.0, 7.0);

TEST(LightTracer, BringsAFloorTheIntensityTimesItsSolidAngle) {
  const TestScene scene = lit_scene(kFloor + kLampAboveFloor);
  const double solid_angle = 2.0 * M_PI * (1.0 - kHeight / std::hypot(kHeight, kFloorRadius));
  expect_power(arriving_power(*scene.loaded().scene, kUnlimited, 50000, is_first),
               kIntensity * solid_angle);
}

TEST(LightTracer, LosesLightOnTheWayByBeersLaw) {
  const glm::dvec3 sigma_t(0.3, 0.6, 1.2);
  const TestScene scene =
      lit_scene(world_fog("0.3, 0.6, 1.2", "0.9, 0.5, 0.7") + kFloor + kLampAboveFloor);
  const double largest_angle = std::atan2(kFloorRadius, kHeight);
  constexpr int kSteps = 1000;
  glm::dvec3 want(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double angle = (i + 0.5) / kSteps * largest_angle;
    const double ring = 2.0 * M_PI * std::sin(angle) * largest_angle / kSteps;
    for (int c = 0; c < 3; ++c)
      want[c] += ring * kIntensity[c] * std::exp(-sigma_t[c] * kHeight / std::cos(angle));
  }
  expect_power(arriving_power(*scene.loaded().scene, kUnlimited, 50000, is_first_on_a_surface),
               want);
}

TEST(LightTracer, SharesPowerBetweenFogAndTheWallsAroundIt) {
  const glm::dvec3 sigma_t(0.3, 0.6, 1.2), albedo(0.9, 0.5, 0.7);
  const TestScene scene =
      lit_scene(world_fog("0.3, 0.6, 1.2", "0.9, 0.5, 0.7") + point_lamp("0, 0, 0", "9, 8, 7") + R"(
    <shape type="sphere"><float name="radius" value="1.5"/>
      <boolean name="flip_normals" value="true"/><bsdf type="diffuse"/></shape>)");
  glm::dvec3 walls, fog;
  for (int c = 0; c < 3; ++c) {
    const double T = std::exp(-1.5 * sigma_t[c]);
    walls[c] = 4.0 * M_PI * kIntensity[c] * T;
    fog[c] = 4.0 * M_PI * kIntensity[c] * albedo[c] * (1.0 - T);
  }
  const Scene& s = *scene.loaded().scene;
  expect_power(arriving_power(s, kUnlimited, 20000, is_first_on_a_surface), walls);
  expect_power(arriving_power(s, kUnlimited, 20000, is_first_in_a_medium), fog);
}

/// An area lamp of radiance (9, 8, 7) and area 1 on which light leaves places as on a wall.
const std::string kReflectingLamp = R"(
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="0.5"/><rotate x="1" angle="90"/><translate x="0.5" y="1.9"/>
    </transform>
    <bsdf type="twosided"><bsdf type="diffuse"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="9, 8, 7"/></emitter>
  </shape>)";

/// Glass takes nothing of the power, whatever refraction does to radiance.
TEST(LightTracer, LosesNothingInGlass) {
  for (const std::string glass : {"dielectric", "thindielectric"}) {
    SCOPED_TRACE(glass);
    const TestScene scene = lit_scene(
        kRoom + kReflectingLamp +
        "<shape type=\"sphere\"><point name=\"center\" value=\"0.5, 0.2, 0\"/><bsdf type=\"" +
        glass + "\"/></shape>");
    const LightTracer tracer(*scene.loaded().scene, kUnlimited);
    std::array<RunningMean, 3> first;
    std::vector<LightVertex> vertices;
    bool met_glass = false;
    for (std::uint32_t i = 0; i < 20000; ++i) {
      vertices.clear();
      Sampler sampler(5, i, 0, true);
      const Vec2 u_direction = sampler.next_2d();
      tracer.trace(tracer.lamps()[0], u_direction, 1.0f, sampler, vertices);
      met_glass = met_glass || (!vertices.empty() && vertices.front().scatterings > 1);
      for (int c = 0; c < 3; ++c)
        first[std::size_t(c)].add(vertices.empty() ? 0.0 : double(vertices.front().power[c]));
    }
    EXPECT_TRUE(met_glass);
    expect_power(first, glm::dvec3(9.0, 8.0, 7.0) * M_PI);
  }
}

TEST(LightTracer, FollowsNoLampBesideLightFromInfinitelyFarAway) {
  const std::string lamps = kRoom + kAreaLamp + kSpotLamp + point_lamp("0, 0, 0", "1, 1, 1");
  const auto followed = [&](const std::string& more) {
    const TestScene scene = lit_scene(lamps + more);
    return LightTracer(*scene.loaded().scene, kUnlimited).lamps().size();
  };
  EXPECT_EQ(followed(""), 3u);
  EXPECT_EQ(followed("<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>"),
            0u);
  EXPECT_EQ(followed("<emitter type=\"directional\"><vector name=\"direction\" value=\"0, -1, 0\"/>"
                     "<rgb name=\"irradiance\" value=\"1\"/></emitter>"),
            0u);
}

/// A lamp in the middle of a diffuse room, and a shell around it.
std::string shell_around(const std::string& lamp, const std::string& bsdf) {
  return kRoom + lamp +
         "<shape type=\"sphere\"><float name=\"radius\" value=\"0.8\"/><boolean "
         "name=\"flip_normals\" value=\"true\"/>" +
         bsdf + "</shape>";
}
const std::string kPoint = point_lamp("0.1, 0, 0", "1, 1, 1");
const std::string kBall = R"(
  <shape type="sphere"><float name="radius" value="0.2"/>
    <emitter type="area"><rgb name="radiance" value="5"/></emitter></shape>)";
const std::string kGlassPane =
    "<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"1.2\"/></bsdf>";
const std::string kRoughGlass =
    "<bsdf type=\"roughdielectric\"><float name=\"alpha\" value=\"0.3\"/></bsdf>";

TEST(LightTracer, LeavesOutWhatOnlyMirrorsSeparateFromALampWithoutExtent) {
  for (const auto& bsdf :
       {kGlassPane, std::string("<bsdf type=\"twosided\"><bsdf type=\"conductor\"/></bsdf>")}) {
    const TestScene scene = lit_scene(shell_around(kPoint, bsdf));
    EXPECT_EQ(most_scatterings(*scene.loaded().scene, kUnlimited, 2000), 0) << bsdf;
  }
  const TestScene rough = lit_scene(shell_around(kPoint, kRoughGlass));
  EXPECT_GT(most_scatterings(*rough.loaded().scene, kUnlimited, 2000), 1);
  const TestScene lamp_with_extent = lit_scene(shell_around(kBall, kGlassPane));
  EXPECT_GT(most_scatterings(*lamp_with_extent.loaded().scene, kUnlimited, 2000), 1);
}

TEST(LightTracer, FollowsLightThatPassesStraightFromALampWithoutExtent) {
  const TestScene scene = lit_scene(shell_around(kPoint, "<bsdf type=\"null\"/>"));
  expect_power(arriving_power(*scene.loaded().scene, kUnlimited, 100, is_first),
               glm::dvec3(4.0 * M_PI));
}

TEST(LightTracer, EndsAfterTheLastScattering) {
  const TestScene scene = lit_scene(kFoggyRoom);
  for (const int last : {1, 2, 5})
    EXPECT_EQ(most_scatterings(*scene.loaded().scene, last, 3000), last);
  EXPECT_GT(most_scatterings(*scene.loaded().scene, kUnlimited, 3000), 10);
}

/// What a place on a surface sends into all directions on one side is what the path takes on: the
/// power that arrives after one scattering is the power that arrives before, scattered.
TEST(LightTracer, TakesOnWhatSurfacesScatter) {
  for (const std::string& bsdf :
       {std::string("<bsdf type=\"diffuse\"/>"), std::string("<bsdf type=\"plastic\"/>"),
        std::string("<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.4\"/></bsdf>"),
        std::string("<bsdf type=\"roughplastic\"><float name=\"alpha\" value=\"0.4\"/></bsdf>")}) {
    SCOPED_TRACE(bsdf);
    const TestScene scene = lit_scene(kLampAboveFloor + R"(
      <shape type="sphere"><float name="radius" value="9"/><point name="center" value="0, 0, 0"/>
        <boolean name="flip_normals" value="true"/><bsdf type="diffuse"/></shape>
      <shape type="disk">
        <transform name="to_world"><scale value="2"/><rotate x="1" angle="-90"/></transform>)" +
                                      bsdf + "</shape>");
    const Scene& s = *scene.loaded().scene;
    const LightTracer tracer(s, 2);
    RunningMean difference, second;
    std::vector<LightVertex> vertices;
    Rng rng(11);
    for (int i = 0; i < 30000; ++i) {
      Sampler sampler(5, std::uint32_t(i), 0, true);
      const Vec2 u_direction = sampler.next_2d();
      vertices.clear();
      tracer.trace(tracer.lamps()[0], u_direction, 1.0f, sampler, vertices);
      double scattered = 0.0, arrived = 0.0;
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const LightVertex& vertex = vertices[k];
        const bool on_disk = vertex.hit && vertex.p.y < 1e-3f && vertex.p.y > -1e-3f &&
                             glm::length(vertex.p) <= 2.01f;
        if (on_disk && vertex.scatterings == 1) {
          // A direction of the upper half, uniformly.
          const float y = rng.next_float(), phi = 2.0f * kPi * rng.next_float();
          const float r = std::sqrt(1.0f - y * y);
          const Vec3 d(r * std::cos(phi), y, r * std::sin(phi));
          scattered = 2.0 * M_PI * double((vertex.power * scattered_toward(s, vertex, d)).g);
        }
        // From the disk by its smooth lobe: a Dirac lobe would have ended the path.
        if (k > 0 && vertex.scatterings == 2 && vertices[k - 1].scatterings == 1 &&
            glm::length(vertices[k - 1].p) <= 2.01f)
          arrived = double(vertex.power.g);
      }
      difference.add(arrived - scattered);
      second.add(arrived);
    }
    EXPECT_TRUE(agrees(difference, 0.0));
    EXPECT_LT(difference.standard_error(), 0.05 * second.mean());
  }
}

}  // namespace
}  // namespace brume::test
