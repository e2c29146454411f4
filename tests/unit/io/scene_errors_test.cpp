// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_fixture.h"

namespace brume {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Broken {
  const char* name;
  const char* body;      // stands from line 2 of a scene with a sensor
  const char* expected;  // first line of the message
};

class BrokenScene : public test::SceneTest, public ::testing::WithParamInterface<Broken> {};

TEST_P(BrokenScene, IsToldWhereAndWhat) {
  EXPECT_EQ(error_line(with_sensor(GetParam().body)), GetParam().expected);
}

const Broken kBroken[] = {
    // Names
    {"parameter_case",
     R"(<medium type="homogeneous" id="fog"><float name="sigma_T" value="1"/></medium>)",
     R"(scene.xml:2:38: unknown parameter "sigma_T" of medium "fog"; did you mean "sigma_t"?)"},
    {"parameter_without_neighbour",
     R"(<shape type="disk"><float name="banana" value="1"/></shape>)",
     R"(scene.xml:2:21: unknown parameter "banana" of disk shape; expected one of exterior, )"
     R"(flip_normals, interior, silhouette_sampling_weight, to_world)"},
    {"element", R"(<shpae type="sphere"/>)",
     R"(scene.xml:2:2: unknown element <shpae>; did you mean "shape"?)"},
    {"attribute", R"(<shape typ="sphere"/>)",
     R"(scene.xml:2:8: unknown attribute "typ" of <shape>; did you mean "type"?)"},
    {"missing_attribute", R"(<shape type="sphere"><float name="radius"/></shape>)",
     R"(scene.xml:2:23: <float> needs the attribute "value")"},
    {"plugin", R"(<bsdf type="difuse" id="a"/><shape type="disk"><ref id="a"/></shape>)",
     R"(scene.xml:2:13: the bsdf type "difuse" is not supported; did you mean "diffuse"? )"
     R"(Supported: diffuse, dielectric, thindielectric, roughdielectric, conductor, )"
     R"(roughconductor, plastic, roughplastic, null, twosided)"},
    {"plugin_unknown", R"(<integrator type="bdpt"/>)",
     R"(scene.xml:2:19: the integrator type "bdpt" is not supported. Supported: volpath, )"
     R"(volpathmis, path, moment, aov)"},
    {"choice",
     R"(<bsdf type="roughconductor" id="a"><string name="distribution" value="ggxx"/></bsdf>)"
     R"(<shape type="disk"><ref id="a"/></shape>)",
     R"(scene.xml:2:71: parameter "distribution" of bsdf "a" is "ggxx"; did you mean "ggx"?)"},
    {"old_name_in_new_dialect", R"(<shape type="disk"><transform name="toWorld"/></shape>)",
     R"(scene.xml:2:21: unknown parameter "toWorld" of disk shape; did you mean "to_world"?)"},
    {"old_element_in_new_dialect",
     R"(<shape type="disk"><transform name="to_world">)"
     R"(<lookAt origin="0 0 0" target="1 0 0" up="0 0 1"/></transform></shape>)",
     R"(scene.xml:2:48: unknown element <lookAt> in a transform; did you mean "lookat"?)"},
    // Values
    {"number", R"(<shape type="sphere"><float name="radius" value="1,5"/></shape>)",
     R"(scene.xml:2:50: "1,5" is not a finite number)"},
    {"nan", R"(<shape type="sphere"><float name="radius" value="nan"/></shape>)",
     R"(scene.xml:2:50: "nan" is not a finite number)"},
    {"negative", R"(<shape type="sphere"><float name="radius" value="-1"/></shape>)",
     R"(scene.xml:2:50: parameter "radius" of sphere shape is -1, but must be positive)"},
    {"integer", R"(<integrator type="path"><integer name="max_depth" value="2.5"/></integrator>)",
     R"(scene.xml:2:58: "2.5" is not an integer)"},
    {"integer_range",
     R"(<integrator type="path"><integer name="max_depth" value="-2"/></integrator>)",
     R"(scene.xml:2:58: parameter "max_depth" of path integrator is -2, but must be in [-1, )"
     R"(1073741824])"},
    {"boolean", R"(<shape type="disk"><boolean name="flip_normals" value="yes"/></shape>)",
     R"(scene.xml:2:56: "yes" is neither true nor false)"},
    {"wrong_type", R"(<shape type="sphere"><string name="radius" value="1"/></shape>)",
     R"(scene.xml:2:23: parameter "radius" of sphere shape is <string>, not a number)"},
    {"float_for_integer",
     R"(<integrator type="path"><float name="max_depth" value="2"/></integrator>)",
     R"(scene.xml:2:26: parameter "max_depth" of path integrator is <float>, not <integer>)"},
    {"albedo_above_one",
     R"(<medium type="homogeneous"><rgb name="albedo" value="0.5 1.5 0"/></medium>)",
     R"(scene.xml:2:54: parameter "albedo" of homogeneous medium is 1.5, but must be in [0, 1])"},
    {"negative_extinction",
     R"(<medium type="homogeneous"><rgb name="sigma_t" value="1 -1 0"/></medium>)",
     R"(scene.xml:2:55: parameter "sigma_t" of homogeneous medium is -1, but must be at least 0)"},
    {"g",
     R"(<medium type="homogeneous"><phase type="hg"><float name="g" value="1.01"/></phase></medium>)",
     R"(scene.xml:2:68: parameter "g" of hg phase is 1.01, but must be in [-1, 1])"},
    {"two_channels", R"(<emitter type="point"><rgb name="intensity" value="1 2"/></emitter>)",
     R"(scene.xml:2:52: a colour is 1 or 3 numbers or #rrggbb, not "1 2")"},
    {"hex", R"(<emitter type="point"><rgb name="intensity" value="#12345"/></emitter>)",
     R"(scene.xml:2:52: "#12345" is not a colour #rrggbb)"},
    {"spectrum_order",
     R"(<emitter type="point"><spectrum name="intensity" value="500:1, 400:2"/></emitter>)",
     R"(scene.xml:2:57: wavelength 400 follows 500; they must increase)"},
    {"spectrum_pair",
     R"(<emitter type="point"><spectrum name="intensity" value="500:1, 2"/></emitter>)",
     R"(scene.xml:2:57: "2" is not a pair wavelength:value)"},
    {"spectrum_negative",
     R"(<emitter type="point"><spectrum name="intensity" value="400:1 700:-1"/></emitter>)",
     R"(scene.xml:2:57: spectrum "intensity" of point emitter is negative somewhere)"},
    {"spectrum_plugin",
     R"(<emitter type="point"><spectrum name="intensity" type="d65"/></emitter>)",
     R"(scene.xml:2:56: spectrum plugins such as "d65" are not supported; give a number or )"
     R"(wavelength:value pairs as value, or an <rgb>)"},
    {"point", R"(<emitter type="point"><point name="position" value="1 2"/></emitter>)",
     R"(scene.xml:2:53: expected 3 numbers, found 2 in "1 2")"},
    {"singular",
     R"(<shape type="disk"><transform name="to_world"><scale x="0"/></transform></shape>)",
     R"(scene.xml:2:21: the transform is singular: it flattens space)"},
    {"transform_beyond_double",
     R"(<shape type="disk"><transform name="to_world"><scale value="1e300"/></transform></shape>)",
     R"(scene.xml:2:21: the transform is not finite: its numbers are too large)"},
    {"rotation_axis",
     R"(<shape type="disk"><transform name="to_world"><rotate angle="9"/></transform></shape>)",
     R"(scene.xml:2:48: the axis of a rotation is zero)"},
    {"matrix",
     R"(<shape type="disk"><transform name="to_world"><matrix value="1 2 3"/></transform></shape>)",
     R"(scene.xml:2:62: a matrix has 9 or 16 numbers, not 3)"},
    {"lookat",
     R"(<shape type="disk"><transform name="to_world">)"
     R"(<lookat origin="0 0 0" target="0 1 0" up="0 1 0"/></transform></shape>)",
     R"(scene.xml:2:48: lookat needs a target apart from its origin and an up that is not along )"
     R"(the view)"},
    {"sheared_sphere",
     R"(<shape type="sphere"><transform name="to_world"><scale x="2"/></transform></shape>)",
     R"(scene.xml:2:23: to_world of sphere shape must move, turn, mirror and scale all axes )"
     R"(alike; use an obj or ply mesh for other forms)"},
    {"ior_name",
     R"(<shape type="disk"><bsdf type="dielectric"><string name="int_ior" value="watr"/></bsdf></shape>)",
     R"(scene.xml:2:74: no index of refraction is known for "watr"; did you mean "water"?)"},
    // Structure
    {"twice",
     "<shape type=\"sphere\">\n<float name=\"radius\" value=\"1\"/>\n"
     "<float name=\"radius\" value=\"2\"/></shape>",
     R"(scene.xml:4:2: parameter "radius" of sphere shape is given twice; first at scene.xml:3:2)"},
    {"attribute_twice", R"(<shape type="disk" type="cube"/>)",
     R"(scene.xml:2:20: attribute "type" is given twice)"},
    {"id_twice", R"(<bsdf type="diffuse" id="a"/><bsdf type="diffuse" id="a"/>)",
     R"(scene.xml:2:55: the id "a" is taken: scene.xml:2:2)"},
    {"reference", R"(<bsdf type="diffuse" id="white"/><shape type="disk"><ref id="whit"/></shape>)",
     R"(scene.xml:2:62: nothing has the id "whit"; did you mean "white"?)"},
    {"cycle",
     R"(<bsdf type="twosided" id="a"><ref id="b"/></bsdf><bsdf type="twosided" id="b">)"
     R"(<ref id="a"/></bsdf>)",
     R"(scene.xml:2:2: bsdf "a" refers to itself)"},
    {"misplaced", R"(<shape type="disk"><film type="hdrfilm"/></shape>)",
     R"(scene.xml:2:21: a <film> does not belong in disk shape)"},
    {"object_for_number",
     R"(<emitter type="point"><texture type="checkerboard" name="intensity"/></emitter>)",
     R"(scene.xml:2:24: "intensity" of point emitter cannot be a <texture>)"},
    {"number_for_object", R"(<shape type="disk"><float name="interior" value="1"/></shape>)",
     R"(scene.xml:2:21: parameter "interior" of disk shape is <float>, not <medium>)"},
    {"bsdf_for_medium",
     R"(<shape type="disk"><bsdf type="diffuse" name="interior"/><bsdf type="null"/></shape>)",
     R"(scene.xml:2:59: disk shape has a second <bsdf>; one is expected)"},
    {"area_in_scene", R"(<emitter type="area"/>)",
     R"(scene.xml:2:2: an area emitter belongs in the shape that emits)"},
    {"point_in_shape", R"(<shape type="disk"><emitter type="point"/></shape>)",
     R"(scene.xml:2:35: a shape takes an emitter of type "area", not "point"; others belong )"
     R"(directly in the scene)"},
    {"two_integrators", R"(<integrator type="path"/><integrator type="path"/>)",
     R"(scene.xml:2:27: scene has a second <integrator>; one is expected)"},
    {"two_worlds", R"(<medium type="homogeneous"/><medium type="homogeneous" id="b"/>)",
     R"(scene.xml:2:30: homogeneous medium and medium "b" would both fill the space outside all )"
     R"(shapes; name one with <ref id="..."/> in the scene, or remove the other)"},
    {"text", "<shape type=\"disk\">fog</shape>", "scene.xml:2:20: text does not belong in <shape>"},
    {"element_in_number",
     R"(<shape type="sphere"><float name="radius" value="1"><ref id="a"/></float></shape>)",
     R"(scene.xml:2:54: <float> has no elements inside)"},
    {"missing_file", R"(<shape type="obj"><string name="filename" value="no.obj"/></shape>)",
     R"(scene.xml:2:50: there is no file "no.obj" (looked in HERE, .))"},
    {"missing_filename", R"(<shape type="ply"/>)",
     R"(scene.xml:2:2: ply shape needs the parameter "filename" (path of a file))"},
    {"undefined", R"(<shape type="sphere"><float name="radius" value="$r"/></shape>)",
     R"(scene.xml:2:50: the parameter "$r" has no value; give it one with -D r=... or <default )"
     R"(name="r" value="..."/> before this line)"},
    {"undefined_near",
     R"(<default name="radius" value="1"/><shape type="sphere"><float name="radius" value="$radiu"/></shape>)",
     R"(scene.xml:2:84: the parameter "$radiu" has no value; did you mean "$radius"?)"},
    {"mixed_sensor_fov",
     "<sensor type=\"thinlens\"><float name=\"aperture_radius\" value=\"1\"/>"
     "<float name=\"fov\" value=\"45\"/><string name=\"focal_length\" value=\"50mm\"/></sensor>",
     R"(scene.xml:2:131: thinlens sensor has both fov and focal_length; give one of them)"},
    {"lens", R"(<sensor type="thinlens"/>)",
     R"(scene.xml:2:2: thinlens sensor needs the parameter "aperture_radius" (radius of the lens )"
     R"(in scene units))"},
    {"volume_extension",
     R"(<medium type="heterogeneous"><volume type="gridvolume" name="sigma_t">)"
     R"(<string name="filename" value="scene.xml"/></volume></medium>)",
     R"(scene.xml:2:102: gridvolume volume does not read ".xml" files; did you mean the volume )"
     R"(type "vdb"?)"},
};

INSTANTIATE_TEST_SUITE_P(All, BrokenScene, ::testing::ValuesIn(kBroken),
                         [](const auto& broken) { return std::string(broken.param.name); });

using SceneErrors = test::SceneTest;

TEST_F(SceneErrors, ShowTheLineWithACaretUnderThePlace) {
  EXPECT_EQ(error("<scene version=\"3.0.0\">\n\t<shpae/>\n</scene>"),
            "scene.xml:2:3: unknown element <shpae>; did you mean \"shape\"?\n"
            "  \t<shpae/>\n"
            "  \t ^");
}

TEST_F(SceneErrors, CutLongLinesAroundThePlace) {
  const std::string filler(500, 'x');
  const std::string message = error("<scene version=\"3.0.0\"><!-- " + filler +
                                    " --><shpae/><!-- " + filler + " --></scene>");
  EXPECT_THAT(message, HasSubstr("...xxxxx"));
  EXPECT_LT(message.size(), 400u);
  // The caret stands under the name.
  const std::size_t caret_line = message.rfind('\n');
  const std::size_t text_line = message.rfind('\n', caret_line - 1);
  const std::size_t column = message.size() - 1 - caret_line;
  EXPECT_EQ(message.substr(text_line + column, 5), "shpae");
}

TEST_F(SceneErrors, NameWhatIsWrongWithTheFileAsAWhole) {
  EXPECT_EQ(error_line(""), "scene.xml:1:1: not well-formed XML: No document element found");
  EXPECT_THAT(error_line("<scene version=\"3.0.0\"><shape></scene>"),
              StartsWith("scene.xml:1:33: not well-formed XML: Start-end tags mismatch"));
  EXPECT_EQ(error_line("<scene/>"),
            "scene.xml:1:2: <scene> needs the attribute \"version\", such as \"3.0.0\"");
  EXPECT_EQ(error_line("<scene version=\"x\"/>"),
            "scene.xml:1:17: \"x\" is not a version number, such as \"3.0.0\"");
  EXPECT_EQ(error_line("<world version=\"3.0.0\"/>"),
            "scene.xml:1:2: the root element is <world>; a scene file begins with <scene>");
  EXPECT_EQ(error_line("<scene version=\"3.0.0\"/>"), "scene.xml:1:2: the scene has no sensor");
  EXPECT_EQ(error_line(std::string("<scene\0/>", 9)),
            "scene.xml:1:1: is not UTF-8 text: byte 6 is zero");
  EXPECT_THAT(error_line("<scene version=\"3.0.0\"/><scene version=\"3.0.0\"/>"),
              HasSubstr("a second root element <scene>"));
}

TEST_F(SceneErrors, NameAMissingFileAFolderAndADevice) {
  Notices notices;
  const auto message = [&](const std::string& name) {
    try {
      load_scene(folder() / name, {}, notices);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("none.xml"), (folder() / "none.xml").string() + ": No such file or directory");
  EXPECT_THAT(message("."), HasSubstr("is a folder, not a file"));
  EXPECT_THAT(message("/dev/zero"), HasSubstr("is a device or a pipe, not a file"));
}

TEST_F(SceneErrors, SayWhereABadVolumeIsNamed) {
  write("short.vol", "VOL\x03");
  EXPECT_EQ(error_line(with_sensor(R"(<medium type="heterogeneous"><volume name="sigma_t" )"
                                   R"(type="gridvolume"><string name="filename" )"
                                   R"(value="short.vol"/></volume></medium>)")),
            "scene.xml:2:102: short.vol: truncated: a .vol header has 48 bytes, the file 4");
}

TEST_F(SceneErrors, NumbersBeyondSinglePrecisionAreRefused) {
  EXPECT_THAT(error_line(with_sensor(
                  R"(<shape type="sphere"><float name="radius" value="1e300"/></shape>)")),
              HasSubstr("\"radius\" of sphere shape is 1e+300, beyond single precision"));
}

TEST_F(SceneErrors, NestingIsLimitedAndNeverOverflowsTheStack) {
  std::string text = "<scene version=\"3.0.0\">";
  for (int i = 0; i < 100000; ++i) text += "<bsdf type=\"twosided\">";
  for (int i = 0; i < 100000; ++i) text += "</bsdf>";
  EXPECT_THAT(error_line(text + "</scene>"), HasSubstr("elements are nested deeper than 64"));
}

TEST_F(SceneErrors, IncludesThatIncludeThemselvesAreRefused) {
  write("a.xml", R"(<scene version="3.0.0"><include filename="b.xml"/></scene>)");
  write("b.xml", R"(<scene version="3.0.0"><include filename="a.xml"/></scene>)");
  EXPECT_THAT(error_line(R"(<scene version="3.0.0"><include filename="a.xml"/></scene>)"),
              StartsWith("b.xml:1:43: \"a.xml\" includes itself"));
}

TEST_F(SceneErrors, ADefinitionThatNothingUsesIsRefused) {
  const std::string text = with_sensor(R"(<default name="spp" value="4"/>)");
  EXPECT_EQ(error_line(text, {{"sp", "8"}}),
            "-D sp=8: scene.xml has no parameter of that name; did you mean \"spp\"?");
  EXPECT_EQ(error_line(text, {{"spp", "8"}}), "");
}

// Every prefix of a scene that uses most of the language is refused with an Error: loading never
// crashes, hangs or takes half a scene for a whole one.
TEST_F(SceneErrors, EveryPrefixOfASceneIsAnError) {
  const std::string text = R"(<?xml version="1.0"?><scene version="3.0.0">
<default name="g" value="0.5"/><integrator type="volpath"/>
<sensor type="perspective"><float name="fov" value="45"/><film type="hdrfilm"/>
<transform name="to_world"><lookat origin="0 0 5" target="0 0 0" up="0 1 0"/></transform></sensor>
<medium type="homogeneous" id="m"><rgb name="sigma_t" value="1 2 3"/>
<phase type="hg"><float name="g" value="$g"/></phase></medium>
<shape type="sphere"><bsdf type="null"/><ref name="interior" id="m"/></shape>
<emitter type="constant"><spectrum name="radiance" value="400:1, 700:2"/></emitter>
</scene>)";
  ASSERT_EQ(error(text), "");
  for (std::size_t n = 0; n < text.size(); ++n) {
    EXPECT_NE(error(text.substr(0, n)), "") << text.substr(0, n);
  }
}

// The same for every single byte that is lost or replaced: any outcome but a crash.
TEST_F(SceneErrors, AnyDamagedByteIsAnErrorOrAScene) {
  const std::string text = with_sensor(
      R"(<medium type="homogeneous" id="m"><float name="sigma_t" value="1e2"/></medium>)"
      R"(<shape type="sphere"><point name="center" x="0" y="1" z="2"/><ref name="interior" id="m"/>)"
      R"(</shape>)");
  int refused = 0, tried = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char* replacement : {"", "<", "\"", "\xff", "9"}) {
      std::string damaged = text;
      damaged.replace(i, 1, replacement);
      refused += error(damaged).empty() ? 0 : 1;
      ++tried;
    }
  }
  EXPECT_GT(refused, tried / 2);
  EXPECT_LT(refused, tried);
}

}  // namespace
}  // namespace brume
