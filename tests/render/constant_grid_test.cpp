// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/constant_vdb.h"
#include "support/render_scene.h"
#include "support/scene_files.h"

// A grid of one value is the homogeneous medium: the same picture from either.

namespace brume::test {
namespace {

constexpr int kSize = 8;           // [pixel]
constexpr int kBlock = 2;          // [pixel]
constexpr int kReplications = 50;  // of 64 samples

struct MediumCase {
  std::string name;
  std::string sigma_t, albedo;  // one number or three
  double g;
};

const MediumCase kThin{"Thin", "0.2", "0.8", 0.0};
const MediumCase kForward{"Forward", "1.5", "0.95", 0.8};
const MediumCase kBackward{"Backward", "3", "0.5", -0.5};
const MediumCase kDense{"Dense", "12", "1", 0.6};
const MediumCase kColouredAlbedo{"ColouredAlbedo", "2.5", "0.95, 0.6, 0.2", 0.3};
const MediumCase kColoured{"Coloured", "4, 1.5, 0.5", "0.9, 0.9, 0.7", 0.4};
const MediumCase kAbsorbing{"Absorbing", "1, 2, 3", "0", 0.0};

std::string rgb(const std::string& name, const std::string& value) {
  return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}

std::string rest_of(const MediumCase& m) {
  return rgb("albedo", m.albedo) + "<phase type=\"hg\"><float name=\"g\" value=\"" +
         std::to_string(m.g) + "\"/></phase></medium>";
}

std::string homogeneous(const MediumCase& m) {
  return "<medium type=\"homogeneous\" id=\"m\">" + rgb("sigma_t", m.sigma_t) + rest_of(m);
}

/// `volume` fills the unit cube, which `placement` takes to where the hull [-1, 1]^3 goes.
std::string heterogeneous(const MediumCase& m, const std::string& volume,
                          const std::string& placement) {
  return "<medium type=\"heterogeneous\" id=\"m\"><volume name=\"sigma_t\" " + volume +
         "<transform name=\"to_world\"><scale value=\"2\"/><translate x=\"-1\" y=\"-1\" "
         "z=\"-1\"/>" +
         placement + "</transform></volume>" + rest_of(m);
}

std::string file(const std::string& type, const std::string& name, const std::string& more = "") {
  return "type=\"" + type + "\"><string name=\"filename\" value=\"" + name + "\"/>" + more;
}

/// What stands in the medium and lights it; the medium fills a cube moved by `placement`.
struct Setting {
  std::string name, contents, sensor, placement;
};

const std::string kLights =
    "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.2, 0.3, 0.5\"/></emitter>"
    "<shape type=\"sphere\"><point name=\"center\" value=\"2, 3, 1.5\"/><float name=\"radius\" "
    "value=\"0.8\"/><emitter type=\"area\"><rgb name=\"radiance\" value=\"12, 10, 8\"/></emitter>"
    "</shape>"
    "<emitter type=\"point\"><point name=\"position\" value=\"-2, 1.5, 2\"/>"
    "<rgb name=\"intensity\" value=\"6, 7, 8\"/></emitter>";

const std::string kThings =
    "<shape type=\"sphere\"><point name=\"center\" value=\"-0.4, 0.1, 0.2\"/><float "
    "name=\"radius\" value=\"0.4\"/><bsdf type=\"dielectric\"/><ref name=\"exterior\" id=\"m\"/>"
    "</shape>"
    "<shape type=\"sphere\"><point name=\"center\" value=\"0.5, -0.3, 0\"/><float "
    "name=\"radius\" value=\"0.35\"/><ref name=\"exterior\" id=\"m\"/></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.6\"/><rotate x=\"1\" "
    "angle=\"-70\"/><translate y=\"-0.6\"/></transform><bsdf type=\"twosided\"><bsdf "
    "type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.2, 0.5, 0.8\"/></bsdf></bsdf></shape>";

const Setting kFromOutside{"FromOutside", "", perspective("0.4, 0.5, 4.5", "0, 0, 0", 36, kSize),
                           ""};
const Setting kWithThings{"WithSurfacesInside", kThings,
                          perspective("-0.3, 0.6, 4.5", "0, 0, 0", 32, kSize), ""};
const Setting kFromInside{"FromInside", "",
                          perspective("0.15, 0.1, 0.35", "0.4, -1, -2", 75, kSize), ""};
const Setting kInsideWithThings{"FromInsideWithSurfaces", kThings,
                                perspective("0.2, 0.3, 0.9", "0, -0.2, 0", 70, kSize), ""};
const Setting kTurned{"Turned", kThings, perspective("-0.3, 0.6, 4.5", "0, 0, 0", 32, kSize),
                      "<scale x=\"-1.2\" y=\"1.4\" z=\"1.1\"/><rotate x=\"1\" y=\"2\" z=\"-1\" "
                      "angle=\"25\"/>"};

std::string scene(const std::string& medium, const Setting& s) {
  return "<scene version=\"3.0.0\">" + medium +
         "<shape type=\"cube\"><transform name=\"to_world\">" + s.placement +
         "</transform><bsdf type=\"null\"/><ref name=\"interior\" id=\"m\"/></shape>" + s.contents +
         kLights + s.sensor + "</scene>";
}

struct Comparison {
  MediumCase medium;
  Setting setting;
  std::string volume_name, volume;
};
void PrintTo(const Comparison& c, std::ostream* out) {
  *out << c.medium.name << c.setting.name;
}

/// The extinction of the medium, as numbers.
std::array<double, 3> numbers(const std::string& text) {
  std::istringstream stream(text);
  std::array<double, 3> values{};
  char comma;
  stream >> values[0];
  values[1] = values[2] = values[0];
  if (stream >> comma) stream >> values[1] >> comma >> values[2];
  return values;
}

class ConstantGrid : public ::testing::TestWithParam<Comparison> {};

TEST_P(ConstantGrid, GivesThePictureOfTheHomogeneousMedium) {
  const auto& [medium, setting, volume_name, volume] = GetParam();
  const TestScene closed_form(scene(homogeneous(medium), setting));
  const auto write_files = [&](const TemporaryFolder& folder) {
    const std::array<double, 3> sigma_t = numbers(medium.sigma_t);
    const int channels = medium.sigma_t.find(',') == std::string::npos ? 1 : 3;
    if (volume_name == "Vol")
      folder.write("constant.vol", vol_bytes({9, 6, 7}, channels,
                                             [&](int, int, int, int c) { return sigma_t[c]; }));
    if (volume_name == "Vdb") write_constant_vdb(folder.path() / "constant.vdb", 12, sigma_t[0]);
  };
  const TestScene tracked(scene(heterogeneous(medium, volume, setting.placement), setting),
                          write_files);
  expect_same_picture(render_path(closed_form, kReplications, 11),
                      render_path(tracked, kReplications, 12), kBlock);
}

std::vector<Comparison> comparisons() {
  const std::string vol = file("gridvolume", "constant.vol");
  const std::string nearest =
      file("gridvolume", "constant.vol", "<string name=\"filter_type\" value=\"nearest\"/>");
  // The grid ends at once: interpolation with the empty space around it would soften its faces.
  const std::string vdb =
      file("vdb", "constant.vdb", "<string name=\"filter_type\" value=\"nearest\"/>");
  const auto constant = [](const MediumCase& m) {
    return "type=\"constvolume\">" + rgb("value", m.sigma_t);
  };
  return {
      {kThin, kFromOutside, "Vol", vol},
      {kThin, kWithThings, "Vol", vol},
      {kForward, kFromOutside, "Vol", vol},
      {kForward, kWithThings, "Vdb", vdb},
      {kForward, kFromInside, "Vol", nearest},
      {kForward, kInsideWithThings, "Vol", vol},
      {kBackward, kFromOutside, "Constant", constant(kBackward)},
      {kBackward, kWithThings, "Vol", vol},
      {kBackward, kTurned, "Vol", vol},
      {kBackward, kFromInside, "Vdb", vdb},
      {kDense, kFromOutside, "Vol", vol},
      {kDense, kWithThings, "Constant", constant(kDense)},
      {kDense, kFromInside, "Vol", vol},
      {kColouredAlbedo, kFromOutside, "Vdb", vdb},
      {kColouredAlbedo, kTurned, "Vdb", vdb},
      {kColouredAlbedo, kInsideWithThings, "Vol", nearest},
      {kColoured, kFromOutside, "Vol", vol},
      {kColoured, kWithThings, "Constant", constant(kColoured)},
      {kColoured, kFromInside, "Vol", vol},
      {kColoured, kTurned, "Vol", vol},
      {kAbsorbing, kWithThings, "Vol", vol},
      {kAbsorbing, kFromInside, "Constant", constant(kAbsorbing)},
  };
}

INSTANTIATE_TEST_SUITE_P(, ConstantGrid, ::testing::ValuesIn(comparisons()),
                         [](const ::testing::TestParamInfo<Comparison>& c) {
                           return c.param.medium.name + c.param.setting.name + c.param.volume_name;
                         });

}  // namespace
}  // namespace brume::test
