// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "statistics/cameras.h"
#include "statistics/fields.h"
#include "statistics/measure.h"
#include "statistics/scene_text.h"

// Isotropic light that enters a body without absorption leaves it after a mean path of 4 V / S,
// whatever scatters in it (Blanco and Fournier 2003). A camera sees this as the loss by a little
// absorption: with the albedo 1 - epsilon, a white environment shows E[(1 - epsilon)^N] after N
// collisions. Three channels of one path have the losses 0, epsilon and 2 epsilon, so that N
// follows to second order without noise in common.

namespace brume::test {
namespace {

constexpr double kEpsilon = 0x1p-10;

std::vector<double> collisions(const CameraSample& s) {
  const double once = double(s.L.r) - double(s.L.g), twice = double(s.L.r) - double(s.L.b);
  return {(4.0 * once - twice) / (2.0 * kEpsilon)};
}

std::string albedo_text() {
  return fmt::format(R"(<rgb name="albedo" value="1, {:.17g}, {:.17g}"/>)", 1.0 - kEpsilon,
                     1.0 - 2.0 * kEpsilon);
}

struct Body {
  const char* name;
  double sigma_t, g;
  glm::dvec3 half;  // of a box; the unit sphere where it is 0
};

void PrintTo(const Body& b, std::ostream* stream) {
  *stream << b.name;
}

class MeanPathLength : public ::testing::TestWithParam<Body> {};

TEST_P(MeanPathLength, IsFourVolumesOverTheSurface) {
  const Body& b = GetParam();
  const bool is_sphere = b.half == glm::dvec3(0.0);
  const std::string shape =
      is_sphere ? R"(<shape type="sphere">)"
                : fmt::format(R"(<shape type="cube"><transform name="to_world"><scale value="{}"/>)"
                              R"(</transform>)",
                              text_of(b.half));
  const std::string medium =
      fmt::format(
          R"(<medium type="homogeneous" name="interior"><float name="sigma_t" value="{}"/>)",
          b.sigma_t) +
      albedo_text() + phase_text(b.g) + "</medium>";
  std::shared_ptr<const Camera> camera = std::make_shared<const SphereEntryCamera>();
  if (!is_sphere) camera = std::make_shared<const BoxEntryCamera>(Vec3(b.half));
  const RunningMean N =
      measure({.xml = scene_text(parallel_sensor({0, 0, 0}, {0, 0, 1}, 3.0) + kUniformLight +
                                 shape + R"(<bsdf type="null"/>)" + medium + "</shape>"),
               .camera = camera},
              collisions)[0];
  const glm::dvec3 e = 2.0 * b.half;
  expect_law(
      {.name = fmt::format("mean path length in {}, sigma_t {:g}, g {:g}", b.name, b.sigma_t, b.g),
       .source = "4 V / S, Blanco and Fournier 2003",
       .expected =
           is_sphere ? 4.0 / 3.0 : 2.0 * e.x * e.y * e.z / (e.x * e.y + e.y * e.z + e.z * e.x)},
      N.mean() / b.sigma_t, N.standard_error() / b.sigma_t);
}
INSTANTIATE_TEST_SUITE_P(
    , MeanPathLength,
    ::testing::Values(Body{"the unit sphere", 1.0, 0.0, {}}, Body{"the unit sphere", 8.0, 0.0, {}},
                      Body{"the unit sphere", 8.0, 0.8, {}}, Body{"the unit sphere", 3.0, -0.5, {}},
                      Body{"a cube of side 2", 2.0, 0.5, {1.0, 1.0, 1.0}},
                      Body{"a box of 1 x 2 x 6", 1.5, 0.0, {0.5, 1.0, 3.0}},
                      Body{"a plate of 2000 x 1 x 2000", 2.0, 0.3, {1000.0, 0.5, 1000.0}}));

TEST(MeanCollisions, InAGridAreFourTimesItsExtinctionOverTheSurface) {
  // N = (4 / S) int sigma_t dV in the cube [-1, 1]^3.
  DensityField field{.n = {4, 5, 6}, .voxel = [](int x, int y, int z) {
                       return 3.0 * ((x + 2 * y + z) % 3) + 0.5 * z;
                     }};
  double sum = 0.0;
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 4; ++x) sum += field.voxel(x, y, z);
  // Clamped at the faces, interpolation keeps the sum of each axis: every voxel has its own volume.
  const double integral = 8.0 * sum / (4 * 5 * 6);
  const RunningMean N = measure(
      {.xml = scene_text(
           parallel_sensor({0, 0, 0}, {0, 0, 1}, 3.0) + kUniformLight +
           R"(<shape type="cube"><bsdf type="null"/><medium type="heterogeneous" name="interior">)"
           R"(<volume name="sigma_t" type="gridvolume"><string name="filename" value="g.vol"/>)"
           R"(<transform name="to_world"><translate value="-0.5, -0.5, -0.5"/><scale value="2"/>)"
           R"(</transform></volume>)" +
           albedo_text() + phase_text(0.4) + "</medium></shape>"),
       .camera = std::make_shared<const BoxEntryCamera>(Vec3(1.0f)),
       .write_files = [&](const TemporaryFolder& f) { f.write("g.vol", field.vol()); }},
      collisions)[0];
  expect_law({.name = "mean number of collisions in a cube of varying density, g 0.4",
              .source = "(4 / S) int sigma_t dV, Blanco and Fournier 2003",
              .expected = 4.0 / 24.0 * integral},
             N.mean(), N.standard_error());
}

class Crossing : public ::testing::TestWithParam<double> {};

TEST_P(Crossing, FractionThatPassesASphere) {
  const double tau = GetParam();
  const RunningMean L = measure_radiance(
      {.xml = scene_text(parallel_sensor({0, 0, 0}, {0, 0, 1}, 3.0) + kUniformLight +
                         R"(<shape type="sphere"><bsdf type="null"/>)" +
                         homogeneous_text(tau, 0.0, 0.0) + "</shape>"),
       .camera = std::make_shared<const SphereEntryCamera>()});
  expect_law({.name = fmt::format("light that crosses an absorbing sphere, sigma_t R = {:g}", tau),
              .source = "(1 - (1 + 2t) exp(-2t)) / (2 t^2)",
              .expected = (1.0 - (1.0 + 2.0 * tau) * std::exp(-2.0 * tau)) / (2.0 * tau * tau)},
             L.mean(), L.standard_error());
}
INSTANTIATE_TEST_SUITE_P(, Crossing, ::testing::Values(0.5, 1.0, 2.0, 5.0));

struct White {
  const char* name;
  const char* medium;
};
class WhiteFurnace : public ::testing::TestWithParam<White> {};

TEST_P(WhiteFurnace, ShowsNothing) {
  DensityField field{.n = {3, 3, 3},
                     .voxel = [](int x, int y, int z) { return 4.0 * ((x + y + z) % 2); }};
  const RunningMean L = measure_radiance(
      {.xml =
           scene_text(parallel_sensor({0.2, 0.1, 0}, {0.2, 0.1, 1}, 3.0) + kUniformFromTwoSkies +
                      R"(<shape type="cube"><bsdf type="null"/>)" + GetParam().medium + "</shape>"),
       .write_files = [&](const TemporaryFolder& f) {
         f.write("g.vol", field.vol());
         write_half_bright_sky(f);
       }});
  expect_law({.name = fmt::format("white furnace, {}", GetParam().name),
              .source = "energy is conserved",
              .expected = 1.0},
             L.mean(), L.standard_error());
}
INSTANTIATE_TEST_SUITE_P(
    , WhiteFurnace,
    ::testing::Values(
        White{"homogeneous cube, sigma_t 3, g 0.8",
              R"(<medium type="homogeneous" name="interior"><float name="sigma_t" value="3"/>)"
              R"(<float name="albedo" value="1"/><phase type="hg"/></medium>)"},
        White{"homogeneous cube, sigma_t 3, g -0.9",
              R"(<medium type="homogeneous" name="interior"><float name="sigma_t" value="3"/>)"
              R"(<float name="albedo" value="1"/><phase type="hg"><float name="g" value="-0.9"/>)"
              R"(</phase></medium>)"},
        White{"homogeneous cube, sigma_t (1, 3, 9)",
              R"(<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="1, 3, 9"/>)"
              R"(<float name="albedo" value="1"/></medium>)"},
        White{"checkerboard of density, g 0.5",
              R"(<medium type="heterogeneous" name="interior"><volume name="sigma_t" )"
              R"(type="gridvolume"><string name="filename" value="g.vol"/><transform )"
              R"(name="to_world"><translate value="-0.5, -0.5, -0.5"/><scale value="2"/>)"
              R"(</transform></volume><float name="albedo" value="1"/><phase type="hg">)"
              R"(<float name="g" value="0.5"/></phase></medium>)"}));

}  // namespace
}  // namespace brume::test
