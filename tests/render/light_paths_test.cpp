// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_paths.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "support/render_scene.h"
#include "support/scene_files.h"

namespace brume::test {
namespace {

/// A room that lamps light, with something in it at which light paths could go wrong.
struct Room {
  std::string name;
  std::string xml;
  std::string camera = perspective("0.1, 0.2, 1.8", "0, -0.3, -1", 75, 6);
  int max_depth = -1;
  int replications = 128;
};
void PrintTo(const Room& room, std::ostream* out) {
  *out << room.name;
}

std::string fog(const std::string& sigma_t, const std::string& g) {
  return "<medium type=\"homogeneous\"><rgb name=\"sigma_t\" value=\"" + sigma_t +
         "\"/><rgb name=\"albedo\" value=\"0.95, 0.9, 0.8\"/><phase type=\"hg\">"
         "<float name=\"g\" value=\"" +
         g + "\"/></phase></medium>";
}

const std::string kGreyFog = fog("0.4, 0.4, 0.4", "0.4");

const std::string kWalls = R"(
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.5, 0.4"/></bsdf>
  </shape>)";

const std::string kAreaLamp = R"(
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="0.5"/><rotate x="1" angle="90"/><translate x="0.5" y="1.9"/>
    </transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="9, 8, 7"/></emitter>
  </shape>)";

const std::string kPointLamp = R"(
  <emitter type="point"><point name="position" x="0.2" y="1.8" z="-0.2"/>
    <rgb name="intensity" value="9, 8, 7"/></emitter>)";

std::string sphere(const std::string& center, const std::string& bsdf) {
  return "<shape type=\"sphere\"><point name=\"center\" value=\"" + center +
         "\"/><float name=\"radius\" value=\"0.7\"/>" + bsdf + "</shape>";
}

const std::string kGlass = sphere("-0.9, -1.2, -0.8", "<bsdf type=\"dielectric\"/>");
const std::string kFrosted = sphere("-0.9, -1.2, -0.8",
                                    "<bsdf type=\"roughdielectric\">"
                                    "<float name=\"alpha\" value=\"0.3\"/></bsdf>");
const std::string kMetal = sphere("0.9, -1.2, -0.5",
                                  "<bsdf type=\"roughconductor\">"
                                  "<float name=\"alpha\" value=\"0.2\"/></bsdf>");
const std::string kPlastic = sphere("0, -1.2, -1.2", "<bsdf type=\"plastic\"/>");

/// Light falls through the gaps between slats that reflect on both sides or on one.
const std::string kSlats = [] {
  std::string slats;
  const std::string white = "<bsdf type=\"diffuse\"/>";
  for (const auto& [x, bsdf] : {std::pair<std::string, std::string>("-1.3", white),
                                {"-0.4", "<bsdf type=\"twosided\">" + white + "</bsdf>"},
                                {"0.6", white},
                                {"1.5", "<bsdf type=\"twosided\">" + white + "</bsdf>"}})
    slats +=
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"0.4\" y=\"2\"/>"
        "<rotate x=\"1\" angle=\"90\"/><translate x=\"" +
        x + "\" y=\"1.2\"/></transform>" + bsdf + "</shape>";
  return slats;
}();

const std::string kSmoke = R"(
  <medium type="heterogeneous" id="smoke">
    <float name="scale" value="2"/><float name="albedo" value="0.9"/>
    <volume name="sigma_t" type="gridvolume"><string name="filename" value="smoke.vol"/>
      <transform name="to_world"><scale value="2"/><translate x="-1" y="-1.5" z="-1.5"/></transform>
    </volume>
  </medium>
  <shape type="cube">
    <transform name="to_world"><translate x="0" y="-0.5" z="-0.5"/></transform>
    <bsdf type="null"/><ref name="interior" id="smoke"/>
  </shape>)";

const std::string kMesh = R"(
  <shape type="obj"><string name="filename" value="torus.obj"/>
    <transform name="to_world"><translate y="-0.8" z="-0.8"/></transform>
    <bsdf type="twosided"><bsdf type="diffuse"/></bsdf>
  </shape>)";

/// A torus whose smooth normals are far from those of its triangles.
std::string coarse_mesh(const std::string& bsdf) {
  return R"(
  <shape type="obj"><string name="filename" value="coarse.obj"/>
    <transform name="to_world"><translate y="-0.8" z="-0.8"/></transform>)" +
         bsdf + "</shape>";
}

/// A folded sheet with smooth normals, seen from below and lit from above.
std::string sheet(const std::string& bsdf) {
  return R"(
  <shape type="obj"><string name="filename" value="sheet.obj"/>
    <transform name="to_world"><translate y="0.9" z="-0.6"/></transform>)" +
         bsdf + "</shape>";
}
std::string sheet_obj() {
  std::ostringstream text;
  constexpr int kFolds = 7;
  for (int i = 0; i < kFolds; ++i)
    for (const double z : {-1.2, 1.2})
      text << "v " << 0.45 * (i - kFolds / 2) << " " << (i % 2 == 0 ? -0.5 : 0.5) << " " << z
           << "\n";
  for (int i = 1; i < kFolds; ++i)
    text << "f " << 2 * i - 1 << " " << 2 * i << " " << 2 * i + 2 << " " << 2 * i + 1 << "\n";
  return text.str();
}

const std::string kSpotLamp = R"(
  <emitter type="spot">
    <transform name="to_world">
      <lookat origin="-1.2, 1.6, 0.4" target="0.3, -1.5, -0.6" up="0, 0, 1"/>
    </transform>
    <rgb name="intensity" value="9, 12, 15"/><float name="cutoff_angle" value="35"/>
  </emitter>)";

/// A wall through the room that reflects on one side only, and one that differs on its sides.
const std::string kPartitions = R"(
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="0.8"/><rotate y="1" angle="60"/><translate x="-1" y="-1" z="-0.8"/>
    </transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="0.8"/><rotate y="1" angle="-60"/><translate x="1" y="-1" z="-0.8"/>
    </transform>
    <bsdf type="twosided">
      <bsdf type="diffuse"><rgb name="reflectance" value="0, 0, 0.9"/></bsdf>
      <bsdf type="roughconductor"><float name="alpha" value="0.4"/></bsdf>
    </bsdf>
  </shape>)";

/// Two fogs that meet in the middle of the room.
const std::string kTwoFogs = R"(
  <medium type="homogeneous" id="thin">
    <rgb name="sigma_t" value="0.2, 0.3, 0.4"/><float name="albedo" value="0.9"/>
  </medium>
  <medium type="homogeneous" id="thick">
    <rgb name="sigma_t" value="2, 1.5, 1"/><rgb name="albedo" value="0.8, 0.9, 0.95"/>
    <phase type="hg"><float name="g" value="0.6"/></phase>
  </medium>
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.5, 0.4"/></bsdf>
    <ref name="exterior" id="thin"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.3, -0.6, -0.8"/><float name="radius" value="1"/>
    <bsdf type="null"/><ref name="interior" id="thick"/><ref name="exterior" id="thin"/>
  </shape>)";

/// A lamp that stands half in a block of fog, and half beside it.
const std::string kLampAcrossABoundary = R"(
  <medium type="homogeneous" id="block">
    <float name="sigma_t" value="1.5"/><float name="albedo" value="0.9"/>
  </medium>
  <shape type="cube">
    <transform name="to_world">
      <scale x="0.9" y="1.4" z="0.9"/><translate x="-0.8" y="-0.4" z="-0.8"/>
    </transform>
    <bsdf type="null"/><ref name="interior" id="block"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale x="1.2" y="0.5"/><rotate x="1" angle="90"/><translate x="0.1" y="0.8" z="-0.8"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="9, 8, 7"/></emitter>
  </shape>)";

/// Fog behind an index-matched boundary, seen from outside.
const std::string kOpenStage = R"(
  <medium type="homogeneous" id="fog">
    <float name="sigma_t" value="0.5"/><float name="albedo" value="0.9"/>
    <phase type="hg"><float name="g" value="-0.3"/></phase>
  </medium>
  <shape type="cube"><transform name="to_world"><scale value="1.1"/></transform>
    <bsdf type="null"/><ref name="interior" id="fog"/></shape>
  <shape type="rectangle">
    <transform name="to_world"><rotate x="1" angle="-90"/><translate y="-1"/></transform>
  </shape>
  <shape type="rectangle"><transform name="to_world"><translate z="-1"/></transform></shape>
  <shape type="rectangle">
    <transform name="to_world"><rotate y="1" angle="90"/><translate x="-1"/></transform>
  </shape>
  <emitter type="spot">
    <transform name="to_world">
      <lookat origin="0.4, 1.6, 0.4" target="-0.4, -1, -0.4" up="0, 0, 1"/>
    </transform>
    <rgb name="intensity" value="9, 9, 9"/><float name="cutoff_angle" value="50"/>
  </emitter>)";

std::vector<Room> rooms() {
  const std::string things = kGlass + kMetal + kPlastic;
  return {
      {.name = "Fog", .xml = kGreyFog + kWalls + kAreaLamp + things},
      {.name = "Vacuum", .xml = kWalls + kAreaLamp + things},
      {.name = "Gaps", .xml = kGreyFog + kWalls + kPointLamp + kSlats + kMetal},
      {.name = "ColouredFog",
       .xml = fog("0.2, 0.5, 1", "-0.4") + kWalls + kPointLamp + kAreaLamp + kFrosted},
      {.name = "Smoke", .xml = kWalls + kAreaLamp + kSmoke},
      {.name = "SmoothMesh", .xml = kGreyFog + kWalls + kPointLamp + kMesh},
      {.name = "SeenFromOutside",
       .xml = kOpenStage,
       .camera = perspective("0.3, 0.2, 4.2", "0, 0, 0", 35, 6)},
      {.name = "Spot", .xml = kWalls + kSpotLamp + kFrosted + kPlastic},
      {.name = "Partitions", .xml = kWalls + kAreaLamp + kPointLamp + kPartitions},
      {.name = "TwoFogs", .xml = kTwoFogs + kAreaLamp},
      {.name = "LampAcrossABoundary", .xml = kWalls + kLampAcrossABoundary},
      {.name = "CoarseMesh",
       .xml = kWalls + kAreaLamp +
              coarse_mesh("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>")},
      {.name = "CoarseMirror",
       .xml = kWalls + kAreaLamp + coarse_mesh("<bsdf type=\"conductor\"/>")},
      {.name = "CoarseGlass",
       .xml = kWalls + kAreaLamp + coarse_mesh("<bsdf type=\"dielectric\"/>")},
      {.name = "CoarsePlastic",
       .xml = kWalls + kAreaLamp + coarse_mesh("<bsdf type=\"plastic\"/>")},
      {.name = "CoarseFrostedGlass",
       .xml = kWalls + kAreaLamp +
              coarse_mesh(
                  "<bsdf type=\"roughdielectric\"><float name=\"alpha\" value=\"0.3\"/></bsdf>")},
      {.name = "Sheet", .xml = kWalls + kAreaLamp + sheet("<bsdf type=\"diffuse\"/>")},
      {.name = "SheetWithTwoSides",
       .xml =
           kWalls + kAreaLamp + sheet("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>")},
      {.name = "TwoScatterings", .xml = kGreyFog + kWalls + kAreaLamp + kMetal, .max_depth = 3},
      {.name = "ThreeScatterings", .xml = kGreyFog + kWalls + kAreaLamp + things, .max_depth = 4},
  };
}

class LightPathsInARoom : public ::testing::TestWithParam<Room> {};

TEST_P(LightPathsInARoom, LeaveThePictureAsItIs) {
  const Room& room = GetParam();
  const std::string xml =
      "<scene version=\"3.0.0\"><integrator type=\"volpath\"><integer name="
      "\"max_depth\" value=\"" +
      std::to_string(room.max_depth) + "\"/></integrator>" + room.xml + room.camera + "</scene>";
  const auto write_files = [](const TemporaryFolder& folder) {
    folder.write("torus.obj", torus_obj(0.75, 0.4));
    folder.write("coarse.obj", torus_obj(0.75, 0.4, 6, 4));
    folder.write("sheet.obj", sheet_obj());
    folder.write("smoke.vol", vol_bytes({8, 8, 8}, 1, [](int x, int y, int z, int) {
                   return (x * y + z) % 5 == 0 ? 1.5 : 0.3;
                 }));
  };
  EstimatorSettings without;
  without.lighting.light_paths = false;
  const TestScene on(xml, write_files), off(xml, write_files, without);
  const LoadedScene& loaded = on.loaded();
  const CameraMedium camera_medium(*loaded.scene, *loaded.camera);
  ASSERT_TRUE(
      LightPaths(*loaded.scene, *loaded.camera, camera_medium, std::numeric_limits<int>::max())
          .exist());

  const Rendered with = render_path(on, room.replications);
  const Rendered reference = render_path(off, 2 * room.replications, 2);
  expect_same_picture(with, reference, 3, {kRed, kGreen, kBlue});
  // The comparison says something.
  for (const Rendered* picture : {&with, &reference}) {
    const RunningMean green = picture->whole(kGreen);
    EXPECT_GT(green.mean(), 0.01);
    EXPECT_LT(green.standard_error(), 0.013 * green.mean())
        << (picture == &with ? "with" : "without") << " light paths";
  }
}

INSTANTIATE_TEST_SUITE_P(, LightPathsInARoom, ::testing::ValuesIn(rooms()),
                         [](const ::testing::TestParamInfo<Room>& c) { return c.param.name; });

}  // namespace
}  // namespace brume::test
