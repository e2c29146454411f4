// SPDX-License-Identifier: Apache-2.0
// What each part of the scene language means, seen through the scene that it builds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/write_image.h"
#include "scene_fixture.h"

namespace brume {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void expect_near(const Rgb& got, const Rgb& want, float tolerance = 1e-5f) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], want[i], tolerance) << "channel " << i;
}

constexpr const char* kDark = "warning: the scene has no emitter: its picture is black";

class SceneFeatures : public test::SceneTest {
 public:
  // Fraction of light that crosses one unit along +X from `p` within the medium there.
  static Rgb transmittance_at(const LoadedScene& loaded, const Vec3& p) {
    const Medium* medium = loaded.scene->medium_at(p).medium;
    if (medium == nullptr) return Rgb(1.0f);
    Rng rng(1);
    return medium->transmittance({.o = p, .d = {1, 0, 0}}, 1.0f, rng);
  }
  // What stands first in the direction +Z from the origin.
  static Hit hit_along_z(const LoadedScene& loaded, const Vec3& o = Vec3(0.0f)) {
    const auto hit = loaded.scene->intersect({.o = o, .d = {0, 0, 1}}, kInfinity);
    EXPECT_TRUE(hit.has_value());
    return hit.value_or(Hit{});
  }
  // Albedo of the material of a disk that `bsdf` describes.
  Rgb albedo_of(const std::string& bsdf) {
    const LoadedScene loaded = load_body(
        "<shape type=\"disk\"><transform name=\"to_world\"><translate z=\"1\"/></transform>" +
        bsdf + "</shape>");
    const Hit hit = hit_along_z(loaded);
    return loaded.scene->bsdf(hit).albedo(hit.uv);
  }
  Rgb environment(const std::string& radiance) {
    return load_body("<emitter type=\"constant\">" + radiance + "</emitter>")
        .scene->lights()
        .environment_radiance({0, 0, 1});
  }
};

TEST_F(SceneFeatures, DefaultsAreThoseOfMitsuba) {
  const LoadedScene loaded = load_body("");
  EXPECT_EQ(loaded.film.size, glm::ivec2(768, 576));
  EXPECT_EQ(loaded.film.crop_size, glm::ivec2(768, 576));
  EXPECT_NE(loaded.film.filter, nullptr);
  EXPECT_EQ(loaded.path.max_depth, -1);
  EXPECT_EQ(loaded.path.rr_depth, 5);
  EXPECT_FALSE(loaded.path.hide_emitters);
  EXPECT_EQ(loaded.sample_count, 16);
  EXPECT_THAT(notices(), ElementsAre(kDark));
}

TEST_F(SceneFeatures, IntegratorsOfEveryNameGiveTheSameSettings) {
  for (const char* type : {"volpath", "volpathmis", "path"}) {
    const LoadedScene loaded = load_body(std::string("<integrator type=\"") + type +
                                         R"("><integer name="max_depth" value="7"/>
        <integer name="rr_depth" value="9"/><boolean name="hide_emitters" value="TRUE"/></integrator>)");
    EXPECT_EQ(loaded.path.max_depth, 7);
    EXPECT_EQ(loaded.path.rr_depth, 9);
    EXPECT_TRUE(loaded.path.hide_emitters);
  }
}

TEST_F(SceneFeatures, AovAndMomentWrapAnIntegrator) {
  const LoadedScene loaded = load_body(R"(<integrator type="moment"><integrator type="aov">
      <string name="aovs" value="dd.y:depth, alb:albedo"/>
      <integrator type="path"><integer name="max_depth" value="3"/></integrator>
      </integrator></integrator>)");
  EXPECT_THAT(loaded.aovs, ElementsAre("depth", "albedo"));
  EXPECT_EQ(loaded.path.max_depth, 3);
}

TEST_F(SceneFeatures, FilmSetsSizeCropAndFilter) {
  const std::string text = R"(<scene version="3.0.0"><sensor type="perspective">
    <sampler type="multijitter"><integer name="sample_count" value="64"/></sampler>
    <film type="hdrfilm"><integer name="width" value="40"/><integer name="height" value="30"/>
      <integer name="crop_offset_x" value="10"/><integer name="crop_offset_y" value="5"/>
      <integer name="crop_width" value="4"/><string name="pixel_format" value="rgba"/>
      <rfilter type="box"/></film></sensor></scene>)";
  const LoadedScene loaded = load(text);
  EXPECT_EQ(loaded.sample_count, 64);
  EXPECT_EQ(loaded.film.size, glm::ivec2(40, 30));
  EXPECT_EQ(loaded.film.crop_offset, glm::ivec2(10, 5));
  EXPECT_EQ(loaded.film.crop_size, glm::ivec2(4, 25));
  EXPECT_EQ(loaded.film.filter->sample({0.0f, 0.75f}), Vec2(-0.5f, 0.25f));

  Notices notices;
  const LoadedScene resized = load_scene(folder() / "scene.xml", {}, notices, glm::ivec2(100, 100));
  EXPECT_EQ(resized.film.size, glm::ivec2(100, 100));
  EXPECT_EQ(resized.film.crop_size, glm::ivec2(100, 100));
  EXPECT_THAT(test::in_words(notices), ElementsAre(HasSubstr("note: another picture size"), kDark));
}

TEST_F(SceneFeatures, PerspectiveLooksAlongLookatWithItsFieldOfView) {
  const auto loaded = load(R"(<scene version="3.0.0"><sensor type="perspective">
    <float name="fov" value="90"/><transform name="to_world">
    <lookat origin="1 2 3" target="1 2 8" up="0 1 0"/></transform></sensor></scene>)");
  const CameraRay middle = loaded.camera->ray({0.5f, 0.5f}, {0.5f, 0.5f});
  EXPECT_NEAR(middle.ray.d.z, 1.0f, 1e-6f);
  EXPECT_NEAR(middle.ray.o.x, 1.0f, 1e-6f);
  // +X is to the left; the picture spans 90 degrees in x.
  const Vec3 left = loaded.camera->ray({0.0f, 0.5f}, {0.5f, 0.5f}).ray.d;
  EXPECT_NEAR(left.x, std::sqrt(0.5f), 1e-5f);
  const Vec3 top = loaded.camera->ray({0.5f, 0.0f}, {0.5f, 0.5f}).ray.d;
  EXPECT_NEAR(top.y / top.z, 576.0f / 768.0f, 1e-5f);
}

TEST_F(SceneFeatures, FocalLengthIsThatOfFullFrameFilm) {
  const auto loaded = load(R"(<scene version="3.0.0"><sensor type="thinlens">
    <string name="focal_length" value="50mm"/><float name="aperture_radius" value="0"/>
    <film type="hdrfilm"><integer name="width" value="36"/><integer name="height" value="24"/>
    </film></sensor></scene>)");
  const Vec3 left = loaded.camera->ray({0.0f, 0.5f}, {0.5f, 0.5f}).ray.d;
  EXPECT_NEAR(left.x / left.z, 18.0f / 50.0f, 1e-5f);
}

TEST_F(SceneFeatures, TransformsApplyInTheOrderWritten) {
  const auto loaded = load_body(R"(<shape type="sphere"><transform name="to_world">
    <scale value="2"/><translate x="3"/><rotate y="1" angle="-90"/>
    <matrix value="1 0 0 0  0 1 0 0.5  0 0 1 0  0 0 0 1"/></transform></shape>)");
  const Hit hit = hit_along_z(loaded, {0, 0.5f, 0});
  EXPECT_NEAR(hit.t, 1.0f, 1e-5f);  // a sphere of radius 2 around (0, 0.5, 3)
}

TEST_F(SceneFeatures, ShapesAreThoseOfMitsuba) {
  write("triangle.obj", "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n");
  write("triangle.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n-9 -9 0\n9 -9 "
        "0\n0 9 0\n3 0 1 2\n");
  struct Case {
    const char* shape;
    float t;  // of the first hit along +Z from (0.1, 0.1, -5)
    float n_z;
  };
  const Case cases[] = {
      {R"(type="rectangle">)", 5.0f, 1.0f},
      {R"(type="disk">)", 5.0f, 1.0f},
      {R"(type="disk"><boolean name="flip_normals" value="true"/>)", 5.0f, -1.0f},
      {R"(type="cube">)", 4.0f, -1.0f},
      {R"(type="sphere"><float name="radius" value="3"/>)", 5.0f - std::sqrt(8.98f), -0.9989f},
      {R"(type="cylinder"><point name="p0" x="-1" y="0" z="0"/><point name="p1" value="1 0 0"/>)",
       5.0f - std::sqrt(0.99f), -std::sqrt(0.99f)},
      {R"(type="obj"><string name="filename" value="triangle.obj"/>)", 5.0f, 1.0f},
      {R"(type="ply"><string name="filename" value="triangle.ply"/>)", 5.0f, 1.0f},
  };
  for (const Case& c : cases) {
    const auto loaded = load_body(std::string("<shape ") + c.shape + "</shape>");
    const Hit hit = hit_along_z(loaded, {0.1f, 0.1f, -5.0f});
    EXPECT_NEAR(hit.t, c.t, 1e-4f) << c.shape;
    EXPECT_NEAR(hit.n.z, c.n_z, 1e-3f) << c.shape;
  }
}

TEST_F(SceneFeatures, ColoursAreReadInEveryForm) {
  expect_near(environment(R"(<float name="radiance" value="2"/>)"), Rgb(2.0f));
  expect_near(environment(R"(<integer name="radiance" value="2"/>)"), Rgb(2.0f));
  expect_near(environment(R"(<rgb name="radiance" value="1, 2 3"/>)"), Rgb(1, 2, 3));
  expect_near(environment(R"(<rgb name="radiance" value="4"/>)"), Rgb(4.0f));
  expect_near(environment(R"(<rgb name="radiance" value="#ff8000"/>)"), Rgb(1, 0.21586f, 0), 1e-4f);
  // Equal energy, seen in Rec. 709.
  expect_near(environment(R"(<spectrum name="radiance" value="1"/>)"),
              Rgb(1.2048f, 0.9483f, 0.9089f), 1e-3f);
  expect_near(
      albedo_of(R"(<bsdf type="diffuse"><spectrum name="reflectance" value="0.25"/></bsdf>)"),
      Rgb(0.25f));
}

TEST_F(SceneFeatures, EveryMaterialLoads) {
  EXPECT_NEAR(albedo_of("").g, 0.5f, 1e-6f);
  EXPECT_NEAR(albedo_of("<emitter type=\"area\"/>").g, 0.0f, 1e-6f);
  expect_near(albedo_of(R"(<bsdf type="null"/>)"), Rgb(1.0f));
  expect_near(
      albedo_of(R"(<bsdf type="diffuse"><rgb name="reflectance" value=".1 .2 .3"/></bsdf>)"),
      Rgb(0.1f, 0.2f, 0.3f));
  expect_near(albedo_of(R"(<bsdf type="twosided"><bsdf type="diffuse"/></bsdf>)"), Rgb(0.5f));
  for (
      const char* body : {
          R"("dielectric"><string name="int_ior" value="diamond"/><float name="ext_ior" value="1"/>)",
          R"("thindielectric"><float name="specular_transmittance" value="0.5"/>)",
          R"("roughdielectric"><float name="alpha" value="0.3"/>)",
          R"("conductor"><string name="material" value="Cu"/>)",
          R"("conductor"><rgb name="eta" value="0.2 0.9 1.1"/><rgb name="k" value="3.9 2.4 2.1"/>)",
          R"("roughconductor"><string name="distribution" value="ggx"/>
              <float name="alpha_u" value="0.1"/><float name="alpha_v" value="0.4"/>)",
          R"("plastic"><boolean name="nonlinear" value="true"/>)",
          R"("roughplastic"><rgb name="diffuse_reflectance" value="0.9 0.1 0.1"/>)",
      }) {
    const Rgb albedo = albedo_of("<bsdf type=" + std::string(body) + "</bsdf>");
    EXPECT_GT(max_component(albedo), 0.0f) << body;
    EXPECT_LE(max_component(albedo), 1.0f) << body;
  }
}

TEST_F(SceneFeatures, TexturesVaryOverTheSurface) {
  const auto loaded = load_body(R"(<shape type="rectangle"><bsdf type="diffuse">
    <texture type="checkerboard" name="reflectance"><float name="color0" value="0.1"/>
    <float name="color1" value="0.9"/></texture></bsdf></shape>)");
  const auto albedo = [&](float x, float y) {
    const Hit hit = hit_along_z(loaded, {x, y, -1});
    return loaded.scene->bsdf(hit).albedo(hit.uv).g;
  };
  EXPECT_FLOAT_EQ(albedo(-0.5f, -0.5f), 0.1f);
  EXPECT_FLOAT_EQ(albedo(0.5f, -0.5f), 0.9f);
}

TEST_F(SceneFeatures, PicturesBecomeTexturesAndEnvironments) {
  Image image{.width = 2, .height = 2, .channels = {"R", "G", "B"}};
  image.pixels = {0.1f, 0.2f, 0.3f, 0.1f, 0.2f, 0.3f, 0.1f, 0.2f, 0.3f, 0.1f, 0.2f, 2.0f};
  write_image((folder() / "picture.exr").string(), image);
  EXPECT_LE(albedo_of(R"(<bsdf type="diffuse"><texture type="bitmap" name="reflectance">
      <string name="filename" value="picture.exr"/><string name="wrap_mode" value="clamp"/>
      <string name="filter_type" value="nearest"/></texture></bsdf>)")
                .b,
            1.0f);
  EXPECT_THAT(notices(), ElementsAre(HasSubstr("1 pixels outside [0, 1] are clamped"), kDark));

  const auto loaded = load_body(R"(<emitter type="envmap">
      <string name="filename" value="picture.exr"/><float name="scale" value="10"/></emitter>)");
  expect_near(loaded.scene->lights().environment_radiance({0, 1, 0}), Rgb(1, 2, 3), 1e-3f);
}

TEST_F(SceneFeatures, EveryEmitterIsALight) {
  for (
      const char* body : {
          R"("point"><point name="position" x="1" y="2" z="3"/><float name="intensity" value="5"/>)",
          R"("spot"><float name="cutoff_angle" value="30"/><float name="beam_width" value="10"/>)",
          R"("directional"><vector name="direction" value="0 0 1"/>)",
          R"("constant">)",
      }) {
    const auto loaded = load_body("<emitter type=" + std::string(body) + "</emitter>");
    EXPECT_EQ(loaded.scene->lights().size(), 1u) << body;
  }
}

TEST_F(SceneFeatures, AMediumInAShapeFillsItAndVacuumIsOutside) {
  const auto loaded = load_body(R"(<shape type="sphere"><bsdf type="null"/>
    <medium type="homogeneous" name="interior"><rgb name="sigma_t" value="1 2 3"/>
      <float name="scale" value="0.5"/><float name="albedo" value="0"/></medium></shape>)");
  expect_near(transmittance_at(loaded, Vec3(0.0f)),
              Rgb(std::exp(-0.5f), std::exp(-1.0f), std::exp(-1.5f)));
  expect_near(transmittance_at(loaded, Vec3(5.0f)), Rgb(1.0f));
}

TEST_F(SceneFeatures, ASceneWithoutEmittersIsSaidToBeBlack) {
  load_body("");
  EXPECT_THAT(notices(), ElementsAre(kDark));
  load_body(R"(<shape type="sphere"><emitter type="area"/></shape>)");
  EXPECT_THAT(notices(), IsEmpty());
  load_body(R"(<emitter type="constant"/>)");
  EXPECT_THAT(notices(), IsEmpty());
}

TEST_F(SceneFeatures, AMediumDirectlyInTheSceneFillsTheSpaceOutsideAllShapes) {
  const auto loaded = load_body(R"(<medium type="homogeneous"/>
    <shape type="sphere"><bsdf type="dielectric"/></shape>)");
  expect_near(transmittance_at(loaded, Vec3(5.0f)), Rgb(std::exp(-1.0f)));
  expect_near(transmittance_at(loaded, Vec3(0.0f)), Rgb(1.0f));
  EXPECT_THAT(notices(), ElementsAre(kDark));

  load_body(R"(<medium type="homogeneous" id="fog"/>)");
  EXPECT_THAT(notices(), ElementsAre(HasSubstr("fills the space outside all shapes"), kDark));
}

TEST_F(SceneFeatures, AMediumThatShapesReferToFillsOnlyThem) {
  const auto loaded = load_body(R"(<medium type="homogeneous" id="fog"/>
    <shape type="sphere"><bsdf type="null"/><ref name="interior" id="fog"/></shape>)");
  expect_near(transmittance_at(loaded, Vec3(5.0f)), Rgb(1.0f));

  const auto both = load_body(R"(<medium type="homogeneous" id="fog"/><ref id="fog"/>
    <shape type="sphere"><bsdf type="null"/><ref name="interior" id="fog"/></shape>)");
  expect_near(transmittance_at(both, Vec3(5.0f)), Rgb(std::exp(-1.0f)));
}

/// A box of fog, and in it a ball of another medium.
std::string ball_in_fog(const std::string& of_the_ball) {
  return R"(<emitter type="point"/>
<shape type="cube"><bsdf type="null"/>
  <medium type="homogeneous" name="interior" id="fog"/></shape>
<shape type="sphere"><float name="radius" value="0.2"/>)" +
         of_the_ball + "</shape>";
}

TEST_F(SceneFeatures, BoundariesThatContradictEachOtherAreNamed) {
  load_body(
      ball_in_fog(R"(<bsdf type="dielectric"/><medium type="homogeneous" name="interior"/>)"));
  EXPECT_THAT(notices(), ElementsAre(AllOf(
                             HasSubstr("scene.xml:5:2: this sphere shape and the cube shape at"),
                             HasSubstr("scene.xml:3:2 contradict each other"),
                             HasSubstr("vacuum by the first and medium \"fog\" by the second"))));

  // Two clouds that overlap.
  load_body(ball_in_fog(R"(<bsdf type="null"/><point name="center" x="1" y="0" z="0"/>
    <medium type="homogeneous" name="interior"/>)"));
  EXPECT_THAT(notices(), ElementsAre(HasSubstr("contradict each other")));
}

TEST_F(SceneFeatures, BoundariesThatAgreeAreNot) {
  const std::vector<std::string> balls = {
      R"(<bsdf type="dielectric"/>)",
      R"(<bsdf type="diffuse"/><medium type="homogeneous" name="interior"/>)",
      R"(<bsdf type="dielectric"/><medium type="homogeneous" name="interior"/>
         <ref name="exterior" id="fog"/>)",
      R"(<bsdf type="dielectric"/><point name="center" x="2" y="0" z="0"/>
         <medium type="homogeneous" name="interior"/>)"};
  for (const std::string& ball : balls) {
    load_body(ball_in_fog(ball));
    EXPECT_THAT(notices(), IsEmpty()) << ball;
  }
}

TEST_F(SceneFeatures, TheMediumThatTheSensorNamesIsCheckedAgainstTheScene) {
  const auto text = [](const char* medium) {
    return std::string(R"(<scene version="3.0.0">
<medium type="homogeneous" id="a"/><medium type="homogeneous" id="b"/>
<shape type="sphere"><bsdf type="null"/><ref name="interior" id="a"/><ref name="exterior" id="b"/></shape>
<sensor type="perspective"><ref id=")") +
           medium + "\"/></sensor></scene>";
  };
  EXPECT_EQ(error(text("a")), "");
  EXPECT_EQ(
      error_line(text("b")),
      "scene.xml:4:29: perspective sensor refers to medium \"b\", but the boundaries around it "
      "put it in medium \"a\"");
}

TEST_F(SceneFeatures, AHeterogeneousMediumOfConstantsFillsTheUnitCube) {
  const auto loaded = load_body(R"(<medium type="heterogeneous">
    <volume type="constvolume" name="sigma_t"><rgb name="value" value="1 2 4"/>
      <transform name="to_world"><scale value="0.5"/></transform></volume>
    <volume type="constvolume" name="albedo"><float name="value" value="0.9"/></volume>
    <float name="scale" value="3"/><phase type="hg"><float name="g" value="-1"/></phase>
    </medium>)");
  // Vacuum beyond the cube; estimated inside, so the mean is compared.
  expect_near(transmittance_at(loaded, {0.6f, 0.25f, 0.25f}), Rgb(1.0f));
  const Medium* medium = loaded.scene->medium_at(Vec3(0.0f)).medium;
  ASSERT_NE(medium, nullptr);
  Rng rng(7);
  glm::dvec3 mean(0.0);
  constexpr int kSamples = 40000;
  for (int i = 0; i < kSamples; ++i) {
    mean += glm::dvec3(medium->transmittance({.o = {-1, 0.25f, 0.25f}, .d = {1, 0, 0}}, 5.0f, rng));
  }
  mean /= kSamples;
  for (int c = 0; c < 3; ++c) {
    const double want = std::exp(-3.0 * 0.5 * (c == 0 ? 1.0 : c == 1 ? 2.0 : 4.0));
    // Each estimate lies in [0, 1]: its standard error is at most 1 / (2 sqrt(n)).
    EXPECT_NEAR(mean[c], want, 4.5 * 0.5 / std::sqrt(double(kSamples)));
  }
}

TEST_F(SceneFeatures, DefaultsDefinitionsIncludesAndAliases) {
  write("parts/materials.xml", R"(<scene version="3.0.0"><default name="grey" value="0.2"/>
    <bsdf type="diffuse" id="paint"><float name="reflectance" value="$grey"/></bsdf></scene>)");
  write("parts/one.xml", R"(<bsdf version="3.0.0" type="null" id="one"/>)");
  const std::string text = with_sensor(R"(<path value="parts"/><default name="z" value="1"/>
    <include filename="materials.xml"/><include filename="one.xml"/><alias id="paint" as="wall"/>
    <shape type="disk"><ref id="wall"/><transform name="to_world"><translate value="0 0 $z"/>
    </transform></shape>)");
  const auto albedo_and_distance = [&](const Definitions& definitions) {
    const LoadedScene loaded = load(text, definitions);
    const Hit hit = hit_along_z(loaded);
    return Vec2(loaded.scene->bsdf(hit).albedo(hit.uv).g, hit.t);
  };
  EXPECT_EQ(albedo_and_distance({}), Vec2(0.2f, 1.0f));
  EXPECT_EQ(albedo_and_distance({{"grey", "0.7"}, {"z", "4"}}), Vec2(0.7f, 4.0f));
}

TEST_F(SceneFeatures, WhatNothingUsesIsNoted) {
  load_body(R"(<bsdf type="diffuse" id="spare"/>)");
  EXPECT_THAT(notices(),
              ElementsAre(kDark, HasSubstr("scene.xml:2:2: bsdf \"spare\" is used nowhere")));
  load_body(R"(<integrator type="path"><integer name="block_size" value="32"/></integrator>)");
  EXPECT_THAT(
      notices(),
      ElementsAre(kDark, "warning: accepted without effect: block_size of path integrator"));
}

// --- The dialect before version 2

TEST_F(SceneFeatures, OldNamesAreRenamed) {
  const auto loaded = load(R"(<scene version="0.6.0"><integrator type="volpath">
    <integer name="maxDepth" value="4"/><integer name="rrDepth" value="6"/></integrator>
    <shape type="disk"><transform name="toWorld"><translate z="2"/></transform>
      <bsdf type="dielectric"><float name="intIOR" value="1.2"/><float name="extIOR" value="1"/>
      </bsdf></shape>
    <sensor type="perspective"><string name="fovAxis" value="y"/><float name="fov" value="60"/>
      <transform name="toWorld"><lookAt origin="0 0 0" target="0 0 1" up="0 1 0"/></transform>
      </sensor></scene>)");
  EXPECT_EQ(loaded.path.max_depth, 4);
  EXPECT_EQ(loaded.path.rr_depth, 6);
  EXPECT_NEAR(hit_along_z(loaded).t, 2.0f, 1e-5f);
}

TEST_F(SceneFeatures, OldMediaMayGiveAbsorptionAndScattering) {
  const auto loaded = load(old_dialect(R"(<medium type="homogeneous" id="m">
    <rgb name="sigmaA" value="1 0 0"/><rgb name="sigmaS" value="1 0 0.5"/>
    <float name="scale" value="2"/></medium>
    <shape type="sphere"><ref name="interior" id="m"/></shape>)"));
  expect_near(transmittance_at(loaded, Vec3(0.0f)), Rgb(std::exp(-4.0f), 1.0f, std::exp(-1.0f)));
  EXPECT_THAT(error_line(with_sensor(R"(<medium type="homogeneous">
<rgb name="sigma_a" value="1"/></medium>)")),
              HasSubstr("unknown parameter \"sigma_a\""));
}

TEST_F(SceneFeatures, AnOldShapeWithAMediumAndNoBsdfIsAnIndexMatchedBoundary) {
  const std::string body = R"(<medium type="homogeneous" id="m"/>
    <shape type="sphere"><ref name="interior" id="m"/></shape>)";
  const auto straight = [](const LoadedScene& loaded) {
    const Hit hit = hit_along_z(loaded);
    return loaded.scene->bsdf(hit).straight_transmittance({0, 0, 1}, hit.uv).g;
  };
  EXPECT_EQ(straight(load(old_dialect(body))), 1.0f);
  EXPECT_EQ(straight(load_body(body)), 0.0f);
}

// A .vol of one voxel of density 1 in the box [0, 2]^3.
TEST_F(SceneFeatures, AnOldGridVolumeFillsTheBoxInItsFile) {
  std::string vol = "VOL\x03";
  for (const std::int32_t i : {1, 1, 1, 1, 1}) {
    vol.append(reinterpret_cast<const char*>(&i), sizeof i);
  }
  for (const float f : {0.0f, 0.0f, 0.0f, 2.0f, 2.0f, 2.0f, 1.0f}) {
    vol.append(reinterpret_cast<const char*>(&f), sizeof f);
  }
  write("one.vol", vol);
  const auto medium = [](const char* parameter, const char* more) {
    return std::string("<medium type=\"heterogeneous\"><volume type=\"gridvolume\" name=\"") +
           parameter + "\"><string name=\"filename\" value=\"one.vol\"/>" + more +
           "</volume></medium>";
  };
  constexpr const char* kUseBox = R"(<boolean name="use_grid_bbox" value="true"/>)";
  // Beyond the box there is vacuum, within it the density is 1 everywhere.
  const Vec3 in_both(0.0f, 0.5f, 0.5f), in_box_only(1.5f, 1.5f, 1.5f);
  const auto is_vacuum = [](const LoadedScene& loaded, const Vec3& p) {
    Rgb sum(0.0f);
    for (int i = 0; i < 8; ++i) sum += transmittance_at(loaded, p + Vec3(0, 0, 0.001f * float(i)));
    return sum == Rgb(8.0f);
  };
  const LoadedScene today = load_body(medium("sigma_t", ""));
  EXPECT_FALSE(is_vacuum(today, in_both));
  EXPECT_TRUE(is_vacuum(today, in_box_only));
  const LoadedScene today_in_box = load_body(medium("sigma_t", kUseBox));
  EXPECT_FALSE(is_vacuum(today_in_box, in_box_only));
  const LoadedScene old = load(old_dialect(medium("density", "")));
  EXPECT_FALSE(is_vacuum(old, in_box_only));
}

TEST_F(SceneFeatures, AnOldSpectrumOfOneNumberIsGreyLight) {
  const auto loaded = load(
      old_dialect(R"(<emitter type="constant"><spectrum name="radiance" value="3"/></emitter>)"));
  expect_near(loaded.scene->lights().environment_radiance({0, 0, 1}), Rgb(3.0f));
}

// --- Far from the origin

TEST_F(SceneFeatures, EverythingKeepsItsPlaceAroundAnOriginNearby) {
  // Floats there are one to two units apart.
  const LoadedScene loaded = load(R"(<scene version="3.0.0">
    <sensor type="perspective"><transform name="to_world">
      <lookat origin="1e7, 2e7, 29999996.5" target="1e7, 2e7, 3e7" up="0, 1, 0"/>
    </transform></sensor>
    <shape type="sphere"><point name="center" value="1e7, 2e7, 3e7"/><bsdf type="null"/>
      <medium name="interior" type="heterogeneous">
        <volume name="sigma_t" type="constvolume"><float name="value" value="1"/>
          <transform name="to_world"><translate value="1e7, 2e7, 3e7"/></transform></volume>
      </medium></shape>
    <shape type="cylinder"><point name="p0" value="1e7, 2e7, 30000004"/>
      <point name="p1" value="1e7, 20000001, 30000004"/></shape>
    <emitter type="point"><point name="position" value="1e7, 20000007, 3e7"/></emitter>
    <emitter type="spot"><transform name="to_world"><translate value="1e7, 2e7, 30000007"/>
      </transform></emitter></scene>)");
  const Ray ray = loaded.camera->ray(Vec2(0.5f), Vec2(0.5f)).ray;
  const auto front = loaded.scene->intersect(ray, kInfinity);
  ASSERT_TRUE(front.has_value());
  EXPECT_NEAR(front->t, 2.5 - 0.01, 1e-6);  // the near clip
  const Vec3 center = front->p + ray.d;
  EXPECT_NEAR(loaded.scene->intersect({center + Vec3(0.0f, 0.5f, 0.0f), ray.d}, 2.0f)->t,
              std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(loaded.scene->intersect({center + Vec3(0.0f, 0.5f, 2.0f), ray.d}, kInfinity)->t, 1.0,
              1e-5);
  expect_near(transmittance_at(loaded, center + Vec3(-0.5f, 0.25f, 0.25f)), Rgb(std::exp(-0.5f)));
  for (std::size_t light = 0; light < 2; ++light) {
    const auto pivot = loaded.scene->lights().light(light).pivot();
    ASSERT_TRUE(pivot.has_value());
    EXPECT_NEAR(glm::distance(pivot->center, center), 7.0, 1e-5);
  }
}

// --- Files beside the source tree and in it

TEST(SampleScenes, EveryOneLoads) {
  const std::filesystem::path samples =
      std::filesystem::path(BRUME_SOURCE_DIR) / "../shared/media-samples/mitsuba";
  if (!std::filesystem::exists(samples)) GTEST_SKIP() << samples << " is not there";
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(samples)) {
    if (entry.path().extension() != ".xml") continue;
    Notices notices;
    EXPECT_NO_THROW(load_scene(entry.path(), {}, notices)) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 12);
}

TEST(ProjectScenes, EveryOneLoadsWithoutNotices) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(BRUME_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".xml") continue;
    Notices notices;
    EXPECT_NO_THROW(load_scene(entry.path(), {}, notices)) << entry.path();
    EXPECT_THAT(test::in_words(notices), IsEmpty()) << entry.path();
  }
}

}  // namespace
}  // namespace brume
