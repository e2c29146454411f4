// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "statistics/fields.h"
#include "statistics/measure.h"
#include "statistics/quadrature.h"
#include "statistics/scene_text.h"

// One scattering (max_depth 2) along a view ray that starts at the origin and goes along +Z, in an
// infinite fog unless said. In double: L = int sigma_s T(camera) p(cos) E dt, where E is what
// arrives from the light.

namespace brume::test {
namespace {

constexpr double kSigmaT = 0.4, kAlbedo = 0.8, kFar = 60.0;
const glm::dvec3 kView(0.0, 0.0, 1.0);

/// In-scattered radiance of one point of the view ray per unit of perpendicular irradiance there.
double scattered(double t, double g, const glm::dvec3& from_light) {
  return kAlbedo * kSigmaT * std::exp(-kSigmaT * t) *
         henyey_greenstein(g, glm::dot(from_light, -kView));
}

/// Irradiance at `p` of a point light of unit intensity in the fog.
double point_irradiance(const glm::dvec3& p, const glm::dvec3& light) {
  const double r = glm::length(p - light);
  return std::exp(-kSigmaT * r) / (r * r);
}

std::string fog(double g) {
  return homogeneous_text(kSigmaT, kAlbedo, g, "");
}
/// A view of a few micro units, so that its pixel is one ray.
std::string sensor() {
  return parallel_sensor({0.0, 0.0, 1e-3}, kView, 1e-3, 1e-6);
}
std::string point_light(const glm::dvec3& p) {
  return fmt::format(
      R"(<emitter type="point"><point name="position" x="{}" y="{}" z="{}"/></emitter>)", p.x, p.y,
      p.z);
}

void expect_radiance(const std::string& name, double expected, const std::string& body) {
  const RunningMean L = measure_radiance({.xml = scene_text(sensor() + body, 2)});
  expect_law({.name = "single scattering, " + name, .source = "quadrature", .expected = expected},
             L.mean(), L.standard_error());
}

class SingleScattering : public ::testing::TestWithParam<double> {
 protected:
  double g() const { return GetParam(); }
  std::string named(const char* name) const { return fmt::format("{}, g {:g}", name, g()); }
};

TEST_P(SingleScattering, OfAPointLight) {
  const glm::dvec3 light(1.0, 0.5, 2.0);
  const double L = integrate(0.0, kFar, 4000, [&](double t) {
    const glm::dvec3 p = t * kView;
    return scattered(t, g(), glm::normalize(p - light)) * point_irradiance(p, light);
  });
  expect_radiance(named("point light"), L, fog(g()) + point_light(light));
}

TEST_P(SingleScattering, OfASpotLight) {
  const glm::dvec3 light(1.5, 0.0, 1.0), target(0.0, 0.0, 2.0);
  const double cutoff = 30.0 * M_PI / 180.0, beam = 20.0 * M_PI / 180.0;
  const double L = integrate(0.0, kFar, 100000, [&](double t) {
    const glm::dvec3 p = t * kView, d = glm::normalize(p - light);
    const double angle = std::acos(glm::dot(d, glm::normalize(target - light)));
    const double falloff = std::clamp((cutoff - angle) / (cutoff - beam), 0.0, 1.0);
    return falloff * scattered(t, g(), d) * point_irradiance(p, light);
  });
  expect_radiance(named("spot light"), L,
                  fog(g()) + fmt::format(R"(<emitter type="spot"><float name="cutoff_angle" )"
                                         R"(value="30"/><float name="beam_width" value="20"/>)"
                                         R"(<transform name="to_world"><lookat origin="{}" )"
                                         R"(target="{}" up="0, 1, 0"/></transform></emitter>)",
                                         text_of(light), text_of(target)));
}

TEST_P(SingleScattering, OfADirectionalLightInABoundedFog) {
  // The cube [-1, 1]^2 x [0, 2], which the view ray crosses in the middle.
  const glm::dvec3 d = glm::normalize(glm::dvec3(0.6, -0.5, 0.3));
  const double L = integrate(0.0, 2.0, 20000, [&](double t) {
    double path = INFINITY;  // back along the light to where it entered
    const glm::dvec3 p(0.0, 0.0, t - 1.0);
    for (int axis = 0; axis < 3; ++axis)
      path = std::min(path, (1.0 + p[axis] * (d[axis] > 0.0 ? 1.0 : -1.0)) / std::abs(d[axis]));
    return scattered(t, g(), d) * std::exp(-kSigmaT * path);
  });
  expect_radiance(
      named("directional light"), L,
      R"(<shape type="cube"><transform name="to_world"><translate z="1"/></transform>)"
      R"(<bsdf type="null"/>)" +
          homogeneous_text(kSigmaT, kAlbedo, g()) + "</shape>" +
          fmt::format(R"(<emitter type="directional"><vector name="direction" x="{:.17g}" )"
                      R"(y="{:.17g}" z="{:.17g}"/></emitter>)",
                      d.x, d.y, d.z));
}

TEST_P(SingleScattering, OfARectangle) {
  // [-0.5, 0.5] x [1, 2] in x and z, at y = 1, shining down.
  const double L = integrate(0.0, kFar, 1000, [&](double t) {
    const glm::dvec3 p = t * kView;
    return integrate(-0.5, 0.5, 4, [&](double x) {
      return integrate(1.0, 2.0, 4, [&](double z) {
        const glm::dvec3 light(x, 1.0, z), d = glm::normalize(p - light);
        return scattered(t, g(), d) * point_irradiance(p, light) * -d.y;
      });
    });
  });
  expect_radiance(named("rectangular light"), L,
                  fog(g()) + R"(<shape type="rectangle"><transform name="to_world">)"
                             R"(<scale value="0.5"/><rotate x="1" angle="90"/>)"
                             R"(<translate y="1" z="1.5"/></transform>)"
                             R"(<emitter type="area"><float name="radiance" value="1"/></emitter>)"
                             R"(</shape>)");
}

TEST_P(SingleScattering, OfASphere) {
  const glm::dvec3 center(0.0, 1.2, 1.5);
  const double radius = 0.5;
  const double L = integrate(0.0, kFar, 600, [&](double t) {
    // Directions of the cone that the sphere fills, each from the near side of the sphere.
    const glm::dvec3 p = t * kView, axis = center - p;
    const double distance = glm::length(axis);
    const glm::dvec3 w = axis / distance, u(1.0, 0.0, 0.0), v = glm::cross(w, u);
    const double half_angle = std::asin(radius / distance);
    return integrate(0.0, half_angle, 6, [&](double theta) {
      const double b = distance * std::cos(theta);
      const double sine = distance * std::sin(theta);
      const double s = b - std::sqrt(std::max(0.0, radius * radius - sine * sine));
      return std::sin(theta) * std::exp(-kSigmaT * s) *
             integrate(0.0, 2.0 * M_PI, 3, [&](double phi) {
               const glm::dvec3 d =
                   std::cos(theta) * w + std::sin(theta) * (std::cos(phi) * u + std::sin(phi) * v);
               return scattered(t, g(), -d);
             });
    });
  });
  expect_radiance(named("spherical light"), L,
                  fog(g()) + R"(<shape type="sphere"><point name="center" x="0" y="1.2" z="1.5"/>)"
                             R"(<float name="radius" value="0.5"/>)"
                             R"(<emitter type="area"><float name="radiance" value="1"/></emitter>)"
                             R"(</shape>)");
}

TEST_P(SingleScattering, OfAPointLightBehindAnOccluder) {
  // The light stands at x = 2; a black strip at x = 1 spans z in [1.2, 1.8] and shades the view
  // ray, at x = 0, from 2 * 1.2 - 2 = 0.4 to 2 * 1.8 - 2 = 1.6.
  const glm::dvec3 light(2.0, 0.0, 2.0);
  const auto L_between = [&](double a, double b) {
    return integrate(a, b, 4000, [&](double t) {
      const glm::dvec3 p = t * kView;
      return scattered(t, g(), glm::normalize(p - light)) * point_irradiance(p, light);
    });
  };
  expect_radiance(named("point light behind an occluder"),
                  L_between(0.0, 0.4) + L_between(1.6, kFar),
                  fog(g()) + point_light(light) +
                      R"(<shape type="rectangle"><transform name="to_world"><scale x="0.3"/>)"
                      R"(<rotate y="1" angle="90"/><translate x="1" z="1.5"/></transform>)"
                      R"(<bsdf type="twosided"><bsdf type="diffuse"><float name="reflectance" )"
                      R"(value="0"/></bsdf></bsdf></shape>)");
}

TEST_P(SingleScattering, InAGridWithALinearRamp) {
  // The unit cube moved to [-0.5, 0.5]^2 x [0, 1] holds a density that rises along z.
  const glm::dvec3 light(1.0, 0.4, 0.6);
  DensityField field{.n = {1, 1, 4}, .voxel = [](int, int, int z) { return 0.5 + z; }};
  field.to_world[3] = glm::dvec4(-0.5, -0.5, 0.0, 1.0);
  const double L = integrate(0.0, 1.0, 64, [&](double t) {
    const glm::dvec3 p = t * kView, d = glm::normalize(p - light);
    const double r = glm::length(p - light);
    return kAlbedo * field.at(p) *
           std::exp(-field.tau({0, 0, 0}, p, 64) - field.tau(p, light, 500)) *
           henyey_greenstein(g(), glm::dot(d, -kView)) / (r * r);
  });
  const RunningMean measured = measure_radiance(
      {.xml = scene_text(
           sensor() + point_light(light) +
               R"(<medium type="heterogeneous"><volume name="sigma_t" type="gridvolume">)"
               R"(<string name="filename" value="ramp.vol"/><transform name="to_world">)"
               R"(<translate x="-0.5" y="-0.5"/></transform></volume>)" +
               fmt::format(R"(<float name="albedo" value="{}"/>)", kAlbedo) + phase_text(g()) +
               "</medium>",
           2),
       .write_files = [&](const TemporaryFolder& f) { f.write("ramp.vol", field.vol()); }});
  expect_law({.name = "single scattering, " + named("point light beside a grid with a linear ramp"),
              .source = "quadrature",
              .expected = L},
             measured.mean(), measured.standard_error());
}

INSTANTIATE_TEST_SUITE_P(, SingleScattering, ::testing::Values(0.0, 0.7));

}  // namespace
}  // namespace brume::test
