// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <ostream>

#include "statistics/fields.h"
#include "statistics/measure.h"
#include "statistics/scene_text.h"
#include "statistics/slab_table.h"

namespace brume::test {
namespace {

std::string matrix_text(const glm::dmat4& m) {
  std::string values;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      values += fmt::format("{}{:.17g}", values.empty() ? "" : " ", m[column][row]);
  return fmt::format(R"(<transform name="to_world"><matrix value="{}"/></transform>)", values);
}

/// A slab, its light and its camera, moved together.
struct Motion {
  std::string name;
  double scale;
  glm::dvec3 offset;  // in thicknesses of the slab
  glm::dmat4 turn{1.0};
  double half_width = kSlabHalfWidth;  // in thicknesses
};

void PrintTo(const Motion& m, std::ostream* stream) {
  *stream << m.name;
}

class Moved : public ::testing::TestWithParam<Motion> {};

TEST_P(Moved, SlabsLookTheSame) {
  const Motion& m = GetParam();
  const SlabReference& slab = *std::find_if(
      std::begin(kSlabs), std::end(kSlabs),
      [](const SlabReference& s) { return s.g == -0.8 && s.albedo == 0.9 && s.tau == 2.0; });
  const glm::dmat4 move = glm::translate(glm::dmat4(1.0), m.scale * m.offset) * m.turn *
                          glm::scale(glm::dmat4(1.0), glm::dvec3(m.scale));
  const glm::dvec3 down(m.turn * glm::dvec4(0.0, -1.0, 0.0, 0.0));
  const std::string sensor = parallel_sensor(glm::dvec3(move * glm::dvec4(0.0, 0.5, 0.0, 1.0)),
                                             down, m.scale, 1e-3 * m.scale);
  const std::string sky =
      R"(<emitter type="envmap"><string name="filename" value="half_lit.pfm"/>)" +
      matrix_text(m.turn) + "</emitter>";
  const std::string body =
      R"(<shape type="cube">)" +
      matrix_text(move * glm::scale(glm::dmat4(1.0), glm::dvec3(m.half_width, 0.5, m.half_width))) +
      R"(<bsdf type="null"/>)" + homogeneous_text(slab.tau / m.scale, slab.albedo, slab.g) +
      "</shape>";
  const auto means =
      measure({.xml = scene_text(sensor + body + sky), .write_files = write_half_lit_sky},
              [](const CameraSample& s) {
                return std::vector<double>{s.L.r, s.L.g};
              });
  const auto check = [&](const char* what, double expected, const RunningMean& mean) {
    expect_law({.name = fmt::format("{} of a slab, g -0.8, albedo 0.9, tau 2, {}", what, m.name),
                .source = "adding-doubling, `reference_slabs.py`",
                .expected = expected},
               mean.mean(), mean.standard_error());
  };
  check("R", slab.R_normal, means[0]);
  check("T", slab.T_normal, means[1]);
}

const glm::dmat4 kTurned = glm::rotate(glm::dmat4(1.0), 1.1, glm::dvec3(0.3, -0.8, 0.5));

// Floats count from the middle of a scene that lies 16 times its own width away; closer than that
// from the origin of its file, where the widest of these slabs at 1e4 would be 0.3% low.
INSTANTIATE_TEST_SUITE_P(
    , Moved,
    ::testing::Values(
        Motion{"scaled by 1e-6", 1e-6, {}}, Motion{"scaled by 1e-3", 1e-3, {}},
        Motion{"scaled by 1e3", 1e3, {}}, Motion{"scaled by 1e6", 1e6, {}},
        Motion{"rotated", 1.0, {}, kTurned},
        Motion{"moved by 100 thicknesses", 1.0, {100.0, 100.0, 100.0}},
        Motion{"moved by 1000 thicknesses", 1.0, {1e3, 1e3, 1e3}},
        Motion{"rotated, then moved by 1000 thicknesses", 1.0, {1e3, 1e3, 1e3}, kTurned},
        Motion{"200 thicknesses wide, moved by 1e4", 1.0, {1e4, 1e4, 1e4}, glm::dmat4(1.0), 100.0},
        Motion{"moved by 1e6 thicknesses", 1.0, {1e6, 1e6, 1e6}},
        Motion{"rotated, then moved by 1e6 thicknesses", 1.0, {1e6, 1e6, 1e6}, kTurned}));

// Helmholtz reciprocity: light of a beam along a that a body sends to a view along b travels
// against b; sent back, it is the beam along b, and the view that it reaches is along a.
TEST(Reciprocity, OfABodyOfEverything) {
  const DensityField field{.n = {5, 4, 6}, .voxel = [](int x, int y, int z) {
                             return 0.5 * ((x * y + 2 * z) % 3) + 0.1 * x;
                           }};
  const glm::dvec3 a = glm::normalize(glm::dvec3(1.0, -0.6, 0.3));
  const glm::dvec3 b = glm::normalize(glm::dvec3(-0.2, 0.5, 1.0));
  const auto seen = [&](const glm::dvec3& beam, const glm::dvec3& view) {
    return measure_radiance(
        {.xml = scene_text(
             parallel_sensor({0, 0, 0}, view, 4.0, 3.6) +
             fmt::format(R"(<emitter type="directional"><vector name="direction" x="{:.17g}" )"
                         R"(y="{:.17g}" z="{:.17g}"/></emitter>)",
                         beam.x, beam.y, beam.z) +
             R"(<shape type="cube"><transform name="to_world"><scale value="0.5, 0.15, 0.3"/>)"
             R"(<translate value="0.3, -0.2, 0.2"/></transform><bsdf type="diffuse">)"
             R"(<float name="reflectance" value="0.7"/></bsdf></shape>)"
             R"(<medium type="heterogeneous"><volume name="sigma_t" type="gridvolume">)"
             R"(<string name="filename" value="g.vol"/><transform name="to_world">)"
             R"(<translate value="-0.5, -0.5, -0.5"/><scale value="2"/></transform></volume>)"
             R"(<float name="albedo" value="0.9"/>)" +
             phase_text(0.6) + "</medium>"),
         .write_files = [&](const TemporaryFolder& f) { f.write("g.vol", field.vol()); }});
  };
  const RunningMean one = seen(a, b), other = seen(b, a);
  expect_law({.name = "a cloud around a diffuse box, beam and view exchanged",
              .source = "reciprocity: the value before the exchange",
              .expected = one.mean(),
              .expected_error = one.standard_error()},
             other.mean(), other.standard_error());
}

}  // namespace
}  // namespace brume::test
