// SPDX-License-Identifier: Apache-2.0
#include "render/reference_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "film/write_image.h"
#include "support/constant_vdb.h"
#include "support/scene_files.h"

namespace brume::test {
namespace {

constexpr int kSize = 8;  // [pixel]

const char* const kFoggyRoom = R"(
  <integrator type="volpath"/>
  <medium type="homogeneous">
    <rgb name="sigma_t" value="0.3, 0.25, 0.2"/>
    <rgb name="albedo" value="0.9, 0.8, 0.7"/>
    <phase type="hg"><float name="g" value="0.5"/></phase>
  </medium>
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="2"/></transform>
    <bsdf type="diffuse">
      <texture name="reflectance" type="checkerboard">
        <rgb name="color0" value="0.7, 0.3, 0.2"/><rgb name="color1" value="0.2, 0.4, 0.6"/>
        <transform name="to_uv"><scale x="3" y="4"/></transform>
      </texture>
    </bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="1.5"/><rotate x="1" angle="90"/><translate y="1.9"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="3, 2.5, 2"/></emitter>
  </shape>
  <shape type="sphere">
    <point name="center" value="-0.8, -1, -0.6"/><float name="radius" value="0.8"/>
    <bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.1, 0.5, 0.3"/></bsdf>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.9, -0.9, 0"/><float name="radius" value="0.8"/>
    <bsdf type="roughplastic">
      <float name="alpha" value="0.3"/>
      <boolean name="nonlinear" value="true"/>
      <texture name="diffuse_reflectance" type="bitmap">
        <string name="filename" value="picture.exr"/>
      </texture>
    </bsdf>
  </shape>)";

const char* const kGlassInFog = R"(
  <integrator type="volpathmis"/>
  <medium type="homogeneous" id="fog">
    <float name="sigma_t" value="0.5"/>
    <rgb name="albedo" value="0.95, 0.9, 0.85"/>
    <phase type="hg"><float name="g" value="0.4"/></phase>
  </medium>
  <medium type="homogeneous" id="ink">
    <rgb name="sigma_t" value="3, 1.5, 0.3"/>
    <rgb name="albedo" value="0.3, 0.5, 0.8"/>
  </medium>
  <shape type="sphere">
    <float name="radius" value="1.6"/>
    <bsdf type="null"/>
    <ref name="interior" id="fog"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="-0.5, 0, 0.1"/><float name="radius" value="0.5"/>
    <bsdf type="dielectric"/>
    <ref name="interior" id="ink"/><ref name="exterior" id="fog"/>
  </shape>
  <shape type="cube">
    <transform name="to_world">
      <scale value="0.35"/><rotate x="1" y="1" angle="30"/><translate x="0.6" y="-0.2"/>
    </transform>
    <bsdf type="roughdielectric">
      <float name="alpha" value="0.3"/><string name="distribution" value="ggx"/>
    </bsdf>
    <ref name="exterior" id="fog"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="0.6"/><rotate y="1" angle="25"/><translate y="0.6" z="0.7"/>
    </transform>
    <bsdf type="thindielectric"><float name="int_ior" value="1.7"/></bsdf>
  </shape>
  <emitter type="envmap">
    <string name="filename" value="picture.exr"/>
    <transform name="to_world"><rotate y="1" x="0.2" angle="70"/></transform>
  </emitter>)";

const char* const kMetalsInSmoke = R"(
  <integrator type="volpath"><integer name="rr_depth" value="2"/></integrator>
  <medium type="heterogeneous">
    <volume name="sigma_t" type="vdb">
      <string name="filename" value="smoke.vdb"/>
      <transform name="to_world">
        <translate x="-0.5" y="-0.5" z="-0.5"/><scale x="2.4" y="3" z="-2.6"/>
        <rotate x="1" z="1" angle="20"/>
      </transform>
    </volume>
    <volume name="albedo" type="gridvolume">
      <string name="filename" value="colour.vol"/>
      <string name="wrap_mode" value="mirror"/>
    </volume>
    <phase type="hg"><float name="g" value="0.7"/></phase>
  </medium>
  <shape type="sphere">
    <point name="center" value="-0.6, -0.2, 0.2"/><float name="radius" value="0.5"/>
    <bsdf type="conductor"><string name="material" value="Au"/></bsdf>
  </shape>
  <shape type="cylinder">
    <point name="p0" value="0.6, -0.9, -0.3"/><point name="p1" value="0.8, 0.2, 0.1"/>
    <float name="radius" value="0.3"/>
    <bsdf type="twosided">
      <bsdf type="roughconductor">
        <string name="material" value="Cu"/><float name="alpha" value="0.4"/>
      </bsdf>
      <bsdf type="diffuse"><rgb name="reflectance" value="0.3, 0.6, 0.9"/></bsdf>
    </bsdf>
  </shape>
  <shape type="disk">
    <transform name="to_world">
      <scale value="1.5"/><rotate x="1" angle="-90"/><translate y="-1"/>
    </transform>
    <bsdf type="roughconductor">
      <float name="alpha_u" value="0.5"/><float name="alpha_v" value="0.2"/>
      <string name="distribution" value="ggx"/>
    </bsdf>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.3, 0.8, 0.2"/><float name="radius" value="0.5"/>
    <emitter type="area"><rgb name="radiance" value="4, 3, 2"/></emitter>
  </shape>
  <emitter type="constant"><rgb name="radiance" value="0.3, 0.5, 0.8"/></emitter>)";

const char* const kSmallLights = R"(
  <integrator type="path"/>
  <medium type="heterogeneous" id="cloud">
    <volume name="sigma_t" type="gridvolume">
      <string name="filename" value="colour.vol"/>
      <transform name="to_world">
        <translate x="-0.5" y="-0.5" z="-0.5"/><scale value="2.2"/><rotate z="1" angle="30"/>
      </transform>
    </volume>
    <float name="scale" value="3"/>
    <rgb name="albedo" value="0.95, 0.9, 0.8"/>
    <phase type="hg"><float name="g" value="-0.3"/></phase>
  </medium>
  <shape type="sphere">
    <bsdf type="null"/>
    <ref name="interior" id="cloud"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="3"/><rotate x="1" angle="-90"/><translate y="-1.1"/>
    </transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.6, 0.5, 0.4"/></bsdf>
  </shape>
  <shape type="sphere">
    <point name="center" value="-1.2, -0.7, 0.9"/><float name="radius" value="0.4"/>
    <bsdf type="roughplastic"><float name="alpha" value="0.2"/></bsdf>
  </shape>
  <emitter type="point">
    <point name="position" value="2, 2, 1"/><rgb name="intensity" value="9, 8, 7"/>
  </emitter>
  <emitter type="spot">
    <transform name="to_world">
      <lookat origin="-2, 3, 1" target="-0.3, 0, 0" up="0, 0, 1"/>
    </transform>
    <rgb name="intensity" value="10, 20, 30"/>
    <float name="cutoff_angle" value="25"/><float name="beam_width" value="15"/>
  </emitter>
  <emitter type="directional">
    <vector name="direction" value="-0.4, -1, -0.6"/><rgb name="irradiance" value="1, 1.5, 2"/>
  </emitter>)";

const char* const kCloudInFog = R"(
  <integrator type="volpath"><integer name="rr_depth" value="50"/></integrator>
  <medium type="homogeneous" id="fog">
    <rgb name="sigma_t" value="0.3, 0.5, 0.7"/>
    <float name="albedo" value="0.9"/>
    <phase type="isotropic"/>
  </medium>
  <medium type="heterogeneous" id="cloud">
    <volume name="sigma_t" type="constvolume">
      <rgb name="value" value="4, 2, 3"/>
      <transform name="to_world"><translate x="-0.5" y="-0.5" z="-0.5"/><scale value="4"/></transform>
    </volume>
    <volume name="albedo" type="constvolume"><rgb name="value" value="0.95, 0.7, 0.9"/></volume>
    <phase type="hg"><float name="g" value="-0.7"/></phase>
  </medium>
  <shape type="cube">
    <transform name="to_world"><scale value="2"/></transform>
    <bsdf type="null"/>
    <ref name="interior" id="fog"/>
  </shape>
  <shape type="obj">
    <string name="filename" value="torus.obj"/>
    <transform name="to_world"><rotate x="1" angle="50"/></transform>
    <bsdf type="null"/>
    <ref name="interior" id="cloud"/><ref name="exterior" id="fog"/>
  </shape>
  <shape type="ply">
    <string name="filename" value="tetrahedron.ply"/>
    <transform name="to_world"><scale value="0.6"/><translate x="0.8" y="1.1" z="-0.5"/></transform>
    <emitter type="area"><rgb name="radiance" value="2, 3, 4"/></emitter>
    <ref name="exterior" id="fog"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="1.5"/><rotate x="1" angle="-90"/><translate y="-1.4"/>
    </transform>
    <bsdf type="diffuse"/>
  </shape>
  <emitter type="constant"><rgb name="radiance" value="0.8, 0.4, 0.2"/></emitter>)";

const char* const kStraightOrBack = R"(
  <integrator type="volpath"/>
  <medium type="homogeneous" id="straight">
    <float name="sigma_t" value="1.5"/>
    <rgb name="albedo" value="0.9, 0.7, 0.5"/>
    <phase type="hg"><float name="g" value="1"/></phase>
  </medium>
  <medium type="homogeneous" id="back">
    <float name="sigma_t" value="1.5"/>
    <rgb name="albedo" value="0.9, 0.8, 0.9"/>
    <phase type="hg"><float name="g" value="-1"/></phase>
  </medium>
  <shape type="sphere">
    <point name="center" value="-0.7, 0, 0"/><float name="radius" value="0.6"/>
    <bsdf type="null"/>
    <ref name="interior" id="straight"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.7, 0, 0"/><float name="radius" value="0.6"/>
    <bsdf type="dielectric"><float name="int_ior" value="1.2"/></bsdf>
    <ref name="interior" id="back"/>
  </shape>
  <shape type="disk">
    <transform name="to_world">
      <scale value="2"/><rotate x="1" angle="-90"/><translate y="-1.5"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="2, 1, 0.5"/></emitter>
  </shape>
  <emitter type="constant"><rgb name="radiance" value="0.5, 0.7, 1"/></emitter>)";

const char* const kShortPaths = R"(
  <integrator type="moment">
    <integrator type="aov">
      <string name="aovs" value="a:albedo, d:depth"/>
      <integrator type="volpath"><integer name="max_depth" value="3"/></integrator>
    </integrator>
  </integrator>
  <medium type="homogeneous" id="fog">
    <float name="sigma_t" value="0.8"/>
    <rgb name="albedo" value="1, 0.9, 0.8"/>
    <phase type="hg"><float name="g" value="0.85"/></phase>
  </medium>
  <shape type="cube">
    <transform name="to_world"><scale x="1.6" y="1.2" z="1"/></transform>
    <bsdf type="null"/>
    <ref name="interior" id="fog"/>
  </shape>
  <shape type="cylinder">
    <point name="p0" value="-1.2, 0.5, -0.3"/><point name="p1" value="1.2, 0.7, 0.2"/>
    <float name="radius" value="0.4"/>
    <emitter type="area"><rgb name="radiance" value="2, 3, 2.5"/></emitter>
  </shape>
  <shape type="sphere">
    <point name="center" value="0, -0.5, 0"/><float name="radius" value="0.5"/>
    <bsdf type="roughconductor">
      <string name="material" value="Al"/><float name="alpha" value="0.25"/>
    </bsdf>
    <ref name="exterior" id="fog"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><scale value="2"/><translate z="-0.8"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.4, 0.6, 0.8"/></bsdf>
  </shape>
  <emitter type="constant"><rgb name="radiance" value="0.2, 0.2, 0.4"/></emitter>)";

const char* const kAllLights = R"(
  <integrator type="volpath"/>
  <medium type="homogeneous" id="fog">
    <rgb name="sigma_t" value="2, 1, 0.5"/>
    <rgb name="albedo" value="0.9, 0.9, 0.9"/>
    <phase type="hg"><float name="g" value="0.6"/></phase>
  </medium>
  <shape type="sphere">
    <bsdf type="null"/>
    <ref name="interior" id="fog"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.2, -0.3, 0.1"/><float name="radius" value="0.4"/>
    <bsdf type="plastic"/>
    <ref name="exterior" id="fog"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="3"/><rotate x="1" angle="-90"/><translate y="-1.2"/>
    </transform>
    <bsdf type="diffuse"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="1.5, 1.6, 0.5"/><float name="radius" value="0.7"/>
    <emitter type="area"><rgb name="radiance" value="3, 2, 1"/></emitter>
  </shape>
  <shape type="disk">
    <transform name="to_world">
      <scale value="0.9"/><rotate y="1" angle="80"/><translate x="-2"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter>
  </shape>
  <emitter type="constant"><rgb name="radiance" value="0.2, 0.1, 0.3"/></emitter>
  <emitter type="envmap">
    <string name="filename" value="picture.exr"/><float name="scale" value="0.5"/>
  </emitter>
  <emitter type="point">
    <point name="position" value="-2, 2, 2"/><rgb name="intensity" value="3, 4, 5"/>
  </emitter>
  <emitter type="spot">
    <transform name="to_world">
      <lookat origin="1, 3, 2" target="0, 0, 0" up="0, 0, 1"/>
    </transform>
    <rgb name="intensity" value="15, 9, 6"/>
  </emitter>
  <emitter type="directional">
    <vector name="direction" value="0.5, -1, 0.1"/><rgb name="irradiance" value="0.5, 0.6, 0.8"/>
  </emitter>)";

const char* const kFogInABox = R"(
  <integrator type="volpath"/>
  <medium type="homogeneous">
    <rgb name="sigma_t" value="0.5, 0.4, 0.2"/>
    <rgb name="albedo" value="0.8, 0.9, 0.95"/>
    <phase type="hg"><float name="g" value="0.6"/></phase>
  </medium>
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.4, 0.3"/></bsdf>
  </shape>)";

const char* const kLampsInFog = R"(
  <shape type="sphere">
    <point name="center" value="-0.6, 0.5, -0.5"/><float name="radius" value="0.25"/>
    <bsdf type="null"/>
  </shape>
  <emitter type="point">
    <point name="position" value="-0.6, 0.5, -0.5"/><rgb name="intensity" value="1.5, 2, 1"/>
  </emitter>
  <shape type="sphere">
    <point name="center" value="0.8, 1.2, -0.3"/><float name="radius" value="0.3"/>
    <bsdf type="null"/>
  </shape>
  <emitter type="spot">
    <transform name="to_world">
      <lookat origin="0.8, 1.2, -0.3" target="0.3, -1, -0.6" up="0, 0, 1"/>
    </transform>
    <rgb name="intensity" value="6, 4, 3"/><float name="cutoff_angle" value="30"/>
  </emitter>
  <shape type="sphere">
    <point name="center" value="0.5, -0.6, -0.4"/><float name="radius" value="0.4"/>
    <emitter type="area"><rgb name="radiance" value="0.6, 0.9, 1.5"/></emitter>
  </shape>)";

/// More lights than are weighed one by one, in a fog that they shine into from near and far.
std::string many_lights() {
  std::string xml;
  for (int i = 0; i < 64; ++i) {
    // One large lamp among small ones; rows that are dark in one colour.
    const double x = i % 4, y = i / 4 % 4, z = i / 16;
    xml += fmt::format(R"(
  <shape type="sphere">
    <point name="center" value="{}, {}, {}"/><float name="radius" value="{}"/>
    <emitter type="area"><rgb name="radiance" value="{}, {}, {}"/></emitter>
  </shape>)",
                       0.8 * x - 1.2, 0.7 * y - 1.1, 0.6 * z - 1.7, i == 21 ? 0.25 : 0.08, 0.5 * x,
                       0.3 + 0.3 * y, 0.4 + 0.2 * z);
  }
  return xml;
}

std::string film(const std::string& filter) {
  const std::string n = std::to_string(kSize);
  return "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" + n +
         "\"/><integer name=\"height\" value=\"" + n + "\"/><rfilter type=\"" + filter +
         "\"/></film>";
}

std::string thin_lens() {
  return "<sensor type=\"thinlens\"><float name=\"fov\" value=\"36\"/><float "
         "name=\"aperture_radius\" value=\"0.2\"/><float name=\"focus_distance\" value=\"4\"/>"
         "<transform name=\"to_world\"><lookat origin=\"0, 0.3, 4.5\" target=\"0, 0, 0\" up=\"0, "
         "1, 0\"/></transform>" +
         film("tent") + "</sensor>";
}

std::string orthographic() {
  return "<sensor type=\"orthographic\"><transform name=\"to_world\"><scale x=\"1.8\" y=\"1.8\"/>"
         "<lookat origin=\"0, 1, 4\" target=\"0, -0.1, 0\" up=\"0, 1, 0\"/></transform>" +
         film("gaussian") + "</sensor>";
}

std::string scene(const std::string& body, const std::string& sensor) {
  return "<scene version=\"3.0.0\">" + body + sensor + "</scene>";
}

}  // namespace

void PrintTo(const ReferenceScene& scene, std::ostream* out) {
  *out << scene.name;
}

const std::vector<ReferenceScene>& reference_scenes() {
  static const std::vector<ReferenceScene> scenes = {
      {"FoggyRoom", scene(kFoggyRoom, perspective("0.2, 0.3, 1.8", "0, -0.5, -1", 75, kSize)), 125},
      {"GlassInFog", scene(kGlassInFog, thin_lens()), 125},
      {"MetalsInSmoke", scene(kMetalsInSmoke, perspective("0, 0.6, 4", "0, 0, 0", 42, kSize)), 125},
      {"SmallLights", scene(kSmallLights, orthographic()), 125},
      {"CloudInFog", scene(kCloudInFog, perspective("0.1, 0.3, 1.7", "0, 0, 0", 80, kSize)), 125},
      {"StraightOrBack", scene(kStraightOrBack, perspective("0, 0.5, 4", "0, 0, 0", 38, kSize)),
       125},
      {"ShortPaths", scene(kShortPaths, perspective("0.3, 0.2, 4.5", "0, 0, 0", 38, kSize)), 125},
      {"LampsInFog",
       scene(std::string(kFogInABox) + kLampsInFog,
             perspective("0.1, 0.2, 1.9", "0, 0, -1", 70, kSize)),
       125},
      {"ManyLights",
       scene(kFogInABox + many_lights(), perspective("0.1, 0.2, 1.9", "0, 0, -1", 70, kSize)), 125},
      {"AllLights", scene(kAllLights, perspective("0.3, 0.6, 4", "0, 0, 0", 38, kSize)), 125},
  };
  return scenes;
}

void write_reference_files(const TemporaryFolder& folder) {
  folder.write("torus.obj", torus_obj(0.75, 0.4));
  folder.write("tetrahedron.ply", tetrahedron_ply());
  folder.write("colour.vol", vol_bytes({5, 6, 7}, 3, [](int x, int y, int z, int c) {
                 return 0.1 + 0.16 * ((x + 2 * y + 3 * z + 5 * c) % 6);
               }));
  write_constant_vdb(folder.path() / "smoke.vdb", 10, 1.2);

  Image picture{.width = 16, .height = 8, .channels = {"R", "G", "B"}};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.pixels.push_back(float(0.5 + 0.35 * std::sin(0.4 * x + c) - 0.04 * y * (c - 1)));
  write_image((folder.path() / "picture.exr").string(), picture);
}

}  // namespace brume::test
