// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "statistics/fields.h"
#include "statistics/measure.h"
#include "statistics/scene_text.h"

// Beer-Lambert: the opacity of a pixel, which is the estimate of transmittance, and by free flights
// the light that comes through where scattering all but goes straight on: only absorption takes
// light then, and a white environment shows exp(-(1 - albedo) tau).

namespace brume::test {
namespace {

struct Case {
  const char* name;
  glm::ivec3 n;
  double (*voxel)(int, int, int);
  glm::dvec3 through;  // a point of the view ray, in the unit cube
  glm::dvec3 d;        // its direction
  bool is_turned;      // rotated, sheared by unequal scales, mirrored
};

// Numbers in [0, 1) without a pattern.
double noise(int x, int y, int z) {
  return std::fmod(std::abs(std::sin(12.9898 * x + 78.233 * y + 37.719 * z)) * 43758.5453, 1.0);
}

const Case kCases[] = {
    {"a linear ramp",
     {1, 1, 16},
     [](int, int, int z) { return 0.125 * z; },
     {0.5, 0.5, 0.5},
     {0.3, 0.2, 1.0},
     false},
    {"a checkerboard of dense and empty",
     {8, 8, 8},
     [](int x, int y, int z) { return (x + y + z) % 2 == 0 ? 6.0 : 0.0; },
     {0.4, 0.5, 0.6},
     {1.0, 0.7, 0.4},
     false},
    {"a checkerboard of dense and empty, turned and mirrored",
     {8, 8, 8},
     [](int x, int y, int z) { return (x + y + z) % 2 == 0 ? 3.0 : 0.0; },
     {0.4, 0.5, 0.6},
     {1.0, 0.7, 0.4},
     true},
    {"a constant grid bounded ten times too high",
     {8, 8, 8},
     [](int x, int y, int z) { return x == 0 && y == 0 ? 15.0 * (z % 2) : 1.5; },
     {0.45, 0.4, 0.5},
     {0.1, 0.05, 1.0},
     false},
    {"one dense voxel",
     {9, 9, 9},
     [](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? 20.0 : 0.0; },
     {0.5, 0.52, 0.47},
     {0.0, 0.0, -1.0},
     false},
    {"noise", {12, 7, 5}, noise, {0.5, 0.45, 0.5}, {-1.0, 0.1, 0.3}, false},
    {"noise, turned and mirrored", {12, 7, 5}, noise, {0.5, 0.45, 0.5}, {0.2, -1.0, 0.3}, true},
    {"noise along the edges of its cells",
     {16, 16, 16},
     noise,
     {0.5, 0.5, 0.5},
     {0.0, 0.0, 1.0},
     false},
};

void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.name;
}

class BeerLambert : public ::testing::TestWithParam<Case> {};

TEST_P(BeerLambert, HoldsInGrids) {
  const Case& c = GetParam();
  const std::string transform =
      c.is_turned ? R"(<transform name="to_world"><scale value="2, 1, -0.7"/>)"
                    R"(<rotate x="1" angle="90"/><translate x="3" y="-1" z="0.5"/></transform>)"
                  : "";
  DensityField field{.n = c.n, .voxel = c.voxel};
  if (c.is_turned) {
    // Scaled, turned by 90 degrees about x (y to z, z to -y), moved.
    field.to_world = glm::dmat4(2, 0, 0, 0, 0, 0, 1, 0, 0, 0.7, 0, 0, 3, -1, 0.5, 1);
  }
  const std::string fog =
      R"(<medium type="heterogeneous"><volume name="sigma_t" type="gridvolume">)"
      R"(<string name="filename" value="field.vol"/>)" +
      transform + R"(</volume><float name="albedo" value="0.5"/>)" + phase_text(0.999999) +
      "</medium>";

  const glm::dvec3 target(field.to_world * glm::dvec4(c.through, 1.0));
  const glm::dvec3 d = glm::normalize(c.d);
  const auto means = [&](const std::string& light) {
    return measure(
        {.xml = scene_text(parallel_sensor(target, d, 10.0, 1e-6) + light + fog),
         .write_files =
             [&](const TemporaryFolder& folder) { folder.write("field.vol", field.vol()); }},
        [](const CameraSample& s) {
          return std::vector<double>{mean(s.L), 1.0 - double(s.alpha)};
        });
  };
  const auto lit = means(kUniformLight);
  // Before a black background the opacity is an estimate of the transmittance alone.
  const auto dark = means("");
  const double tau = field.tau(target - 10.0 * d, target + 10.0 * d, 40000);
  expect_law({.name = fmt::format("light through {}, albedo 0.5, g 0.999999", c.name),
              .source = "Beer-Lambert, quadrature",
              .expected = std::exp(-0.5 * tau)},
             lit[0].mean(), lit[0].standard_error());
  expect_law({.name = fmt::format("share of the background seen through {}", c.name),
              .source = "Beer-Lambert, quadrature",
              .expected = std::exp(-tau)},
             lit[1].mean(), lit[1].standard_error());
  expect_law({.name = fmt::format("transmittance of {}", c.name),
              .source = "Beer-Lambert, quadrature",
              .expected = std::exp(-tau)},
             dark[1].mean(), dark[1].standard_error());
}
INSTANTIATE_TEST_SUITE_P(, BeerLambert, ::testing::ValuesIn(kCases));

// Where minimum and maximum are one, there is nothing left to estimate. (More than a tenth comes
// through: below, roulette would bring its noise.)
TEST(BeerLambertInAConstantGrid, IsExactAtAnyAngle) {
  for (const glm::dvec3& d :
       {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(1.0, 1.0, 1.0),
        glm::dvec3(-0.3, 0.9, 1e-9), glm::dvec3(1.0, -2.0, 0.5)}) {
    DensityField field{.n = {8, 5, 6}, .voxel = [](int, int, int) { return 0.9; }};
    field.to_world = glm::dmat4(0, 2, 0, 0, -0.7, 0, 0, 0, 0, 0.4, 1, 0, -1, 3, 0.5, 1);
    const std::string fog =
        R"(<medium type="heterogeneous"><volume name="sigma_t" type="gridvolume">)"
        R"(<string name="filename" value="field.vol"/><transform name="to_world"><matrix )"
        R"(value="0 -0.7 0 -1  2 0 0.4 3  0 0 1 0.5  0 0 0 1"/></transform></volume></medium>)";
    const glm::dvec3 target(field.to_world * glm::dvec4(0.4, 0.55, 0.6, 1.0));
    const auto opacity = measure(
        {.xml = scene_text(parallel_sensor(target, d, 10.0, 1e-6) + fog),
         .write_files =
             [&](const TemporaryFolder& folder) { folder.write("field.vol", field.vol()); }},
        [](const CameraSample& s) { return std::vector<double>{double(s.alpha)}; });
    // The box of the grid is crossed between two planes in each of its own axes.
    const glm::dvec3 o = target - 10.0 * glm::normalize(d);
    const glm::dmat4 unit = glm::inverse(field.to_world);
    const glm::dvec3 unit_o(unit * glm::dvec4(o, 1.0));
    const glm::dvec3 unit_d(glm::dmat3(unit) * glm::normalize(d));
    const glm::dvec3 a = -unit_o / unit_d, b = (1.0 - unit_o) / unit_d;
    const glm::dvec3 enters = glm::min(a, b), leaves = glm::max(a, b);
    const double length =
        std::min({leaves.x, leaves.y, leaves.z}) - std::max({enters.x, enters.y, enters.z});
    // What floats know of a ray that starts 10 units away.
    EXPECT_NEAR(opacity[0].mean(), -std::expm1(-0.9 * length), 1e-5);
  }
}

}  // namespace
}  // namespace brume::test
