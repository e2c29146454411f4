// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <ostream>

#include "statistics/constant_nvdb.h"
#include "statistics/fields.h"
#include "statistics/measure.h"
#include "statistics/scene_text.h"
#include "statistics/slab_table.h"
#include "support/constant_vdb.h"

// One slab, written in every way that the scene language has, with one answer: reflectance and
// transmittance depend only on its optical thickness, however that is spread over its depth.

namespace brume::test {
namespace {

constexpr double kTau = 2.0, kAlbedo = 0.9, kG = -0.8;

SlabReference reference() {
  return *std::find_if(std::begin(kSlabs), std::end(kSlabs), [](const SlabReference& s) {
    return s.g == kG && s.albedo == kAlbedo && s.tau == kTau;
  });
}

std::string heterogeneous(const std::string& volume, const std::string& place) {
  return fmt::format(
      R"(<medium type="heterogeneous" {}>{}<float name="albedo" value="{}"/>{}</medium>)", place,
      volume, kAlbedo, phase_text(kG));
}

/// From the unit cube to the slab.
std::string to_slab(const std::string& first = "") {
  return fmt::format(R"(<transform name="to_world"><translate value="-0.5, -0.5, -0.5"/>{})"
                     R"(<scale value="{:g}, 1, {:g}"/></transform>)",
                     first, 2.0 * kSlabHalfWidth, 2.0 * kSlabHalfWidth);
}

std::string volume(const std::string& type, const std::string& file,
                   const std::string& first = "") {
  return fmt::format(
      R"(<volume name="sigma_t" type="{}"><string name="filename" value="{}"/>{}</volume>)", type,
      file, to_slab(first));
}

/// Files with grids of 8^3 voxels.
void write_grids(const TemporaryFolder& folder) {
  write_half_lit_sky(folder);
  constexpr int n = 8;
  const auto write = [&](const char* name, auto&& value) {
    folder.write(name, DensityField{.n = glm::ivec3(n), .voxel = value}.vol());
  };
  write("constant.vol", [](int, int, int) { return kTau; });
  // Rises along y, along z; the mean is that of the others.
  write("ramp_y.vol", [](int, int y, int) { return kTau * (y + 0.5) / (0.5 * n); });
  write("ramp_z.vol", [](int, int, int z) { return kTau * (z + 0.5) / (0.5 * n); });
  // One voxel, in the corner, ten times denser: it raises the bounds of half of the grid along
  // each axis and is thousands of thicknesses away from what is seen.
  write("spike.vol",
        [](int x, int y, int z) { return x == 0 && y == 0 && z == 0 ? 10.0 * kTau : kTau; });
  write_constant_vdb(folder.path() / "constant.vdb", n, kTau);
  write_constant_nvdb(folder.path() / "constant.nvdb", n, kTau);
}

struct Representation {
  const char* name;
  std::string body;
};

void PrintTo(const Representation& r, std::ostream* stream) {
  *stream << r.name;
}

std::vector<Representation> representations() {
  const auto in_hull = [](const std::string& v) {
    return slab_text(heterogeneous(v, R"(name="interior")"));
  };
  const auto in_space = [](const std::string& v) { return heterogeneous(v, ""); };
  return {
      {"homogeneous", slab_text(homogeneous_text(kTau, kAlbedo, kG))},
      {"a constant volume",
       in_hull(fmt::format(R"(<volume name="sigma_t" type="constvolume"><float name="value" )"
                           R"(value="{}"/>{}</volume>)",
                           kTau, to_slab()))},
      {"a constant .vol", in_hull(volume("gridvolume", "constant.vol"))},
      {"a constant .vol without a hull", in_space(volume("gridvolume", "constant.vol"))},
      {"a .vol with a majorant ten times too high", in_space(volume("gridvolume", "spike.vol"))},
      {"a .vol that is denser below", in_hull(volume("gridvolume", "ramp_y.vol"))},
      {"a .vol turned so that its z is up",
       in_hull(volume("gridvolume", "ramp_z.vol", R"(<rotate x="1" angle="-90"/>)"))},
      {"a mirrored .vol",
       in_space(volume("gridvolume", "ramp_y.vol", R"(<scale value="-1, -1, 1"/>)"))},
      {"a .vdb", in_space(volume("vdb", "constant.vdb"))},
      {"a .nvdb", in_space(volume("vdb", "constant.nvdb"))},
  };
}

class Representations : public ::testing::TestWithParam<Representation> {};

TEST_P(Representations, GiveOneAnswer) {
  const SlabReference slab = reference();
  const auto means =
      measure({.xml = scene_text(sensor_at_cosine(1.0) + GetParam().body + kHalfLitSky),
               .write_files = write_grids},
              [](const CameraSample& s) {
                return std::vector<double>{s.L.r, s.L.g};
              });
  const auto check = [&](const char* what, double expected, const RunningMean& m) {
    expect_law({.name = fmt::format("{} of a slab, g -0.8, albedo 0.9, tau 2, as {}", what,
                                    GetParam().name),
                .source = "adding-doubling, `reference_slabs.py`",
                .expected = expected},
               m.mean(), m.standard_error());
  };
  check("R", slab.R_normal, means[0]);
  check("T", slab.T_normal, means[1]);
}
INSTANTIATE_TEST_SUITE_P(, Representations, ::testing::ValuesIn(representations()));

}  // namespace
}  // namespace brume::test
