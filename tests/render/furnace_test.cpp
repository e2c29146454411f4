// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "film/write_image.h"
#include "support/render_scene.h"
#include "support/scene_files.h"

// White furnace: where nothing absorbs and every light has radiance 1, every point of every picture
// is 1, whatever scatters in between.

namespace brume::test {
namespace {

constexpr int kSize = 6;           // [pixel]
constexpr int kReplications = 80;  // of 64 samples

void write_files(const TemporaryFolder& folder) {
  folder.write("torus.obj", torus_obj(0.75, 0.4));
  folder.write("tetrahedron.ply", tetrahedron_ply());
  folder.write("grey.vol", vol_bytes({7, 5, 6}, 1, [](int x, int y, int z, int) {
                 return (x + y + z) % 3 == 0 ? 0.0 : 0.4 + 0.3 * ((x * y + z) % 5);
               }));
  folder.write("colour.vol", vol_bytes({4, 6, 5}, 3, [](int x, int y, int z, int c) {
                 return 0.1 + 0.4 * ((x + 2 * y + 3 * z + 5 * c) % 6);
               }));
  Image white{.width = 8, .height = 4, .channels = {"R", "G", "B"}};
  white.pixels.assign(8 * 4 * 3, 1.0f);
  write_image((folder.path() / "white.exr").string(), white);
}

std::string phase(double g) {
  return "<phase type=\"hg\"><float name=\"g\" value=\"" + std::to_string(g) + "\"/></phase>";
}

/// A medium without absorption, called "m".
std::string homogeneous(const std::string& sigma_t, double g) {
  return "<medium type=\"homogeneous\" id=\"m\"><rgb name=\"sigma_t\" value=\"" + sigma_t +
         "\"/><float name=\"albedo\" value=\"1\"/>" + phase(g) + "</medium>";
}
std::string heterogeneous(const std::string& file, double scale, double g) {
  return "<medium type=\"heterogeneous\" id=\"m\"><volume name=\"sigma_t\" type=\"gridvolume\">"
         "<string name=\"filename\" value=\"" +
         file +
         "\"/><transform name=\"to_world\"><translate x=\"-0.5\" y=\"-0.5\" z=\"-0.5\"/>"
         "<scale x=\"2\" y=\"-2\" z=\"1.5\"/><rotate x=\"1\" y=\"1\" angle=\"35\"/></transform>"
         "</volume><float name=\"scale\" value=\"" +
         std::to_string(scale) + "\"/><float name=\"albedo\" value=\"1\"/>" + phase(g) +
         "</medium>";
}

std::string hull(const std::string& shape, const std::string& inside) {
  return "<shape type=\"" + shape + "\">" + inside +
         "<bsdf type=\"null\"/><ref name=\"interior\" id=\"m\"/></shape>";
}

const std::string kSphere = hull("sphere", "");
const std::string kSkewedCube = hull("cube",
                                     "<transform name=\"to_world\"><scale x=\"-0.9\" y=\"0.5\" "
                                     "z=\"0.7\"/><rotate x=\"1\" y=\"2\" z=\"3\" angle=\"50\"/>"
                                     "</transform>");
const std::string kTorus = hull("obj",
                                "<string name=\"filename\" value=\"torus.obj\"/>"
                                "<transform name=\"to_world\"><rotate x=\"1\" angle=\"40\"/>"
                                "</transform>");
const std::string kTetrahedron =
    hull("ply", "<string name=\"filename\" value=\"tetrahedron.ply\"/>");
/// A tube with lids.
const std::string kCylinder =
    hull("cylinder",
         "<float name=\"radius\" value=\"0.7\"/><point name=\"p0\" value=\"0, -0.8, 0\"/>"
         "<point name=\"p1\" value=\"0, 0.8, 0\"/>") +
    hull("disk",
         "<transform name=\"to_world\"><scale value=\"0.7\"/><rotate x=\"1\" angle=\"-90\"/>"
         "<translate y=\"0.8\"/></transform>") +
    hull("disk",
         "<transform name=\"to_world\"><scale value=\"0.7\"/><rotate x=\"1\" angle=\"90\"/>"
         "<translate y=\"-0.8\"/></transform>");
/// A grid without a hull: the medium fills the space that its own box gives it.
const std::string kNoHull;
/// A ball of the medium inside a mirrored ellipsoidal cloud of another.
const std::string kNested =
    "<medium type=\"homogeneous\" id=\"outer\"><rgb name=\"sigma_t\" value=\"0.9, 0.5, 0.7\"/>"
    "<float name=\"albedo\" value=\"1\"/>" +
    phase(0.6) +
    "</medium>"
    "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"-1\"/><rotate z=\"1\" "
    "angle=\"20\"/></transform><bsdf type=\"null\"/><ref name=\"interior\" id=\"outer\"/></shape>"
    "<shape type=\"sphere\"><float name=\"radius\" value=\"0.5\"/><bsdf type=\"null\"/>"
    "<ref name=\"interior\" id=\"m\"/><ref name=\"exterior\" id=\"outer\"/></shape>";

const std::string kEnvironment = "<emitter type=\"constant\"/>";
const std::string kFar = perspective("0.3, 0.4, 4", "0, 0, 0", 34, kSize);
const std::string kWithin = perspective("0.1, 0.15, 0.2", "0.3, -1, -2", 70, kSize);

struct FurnaceCase {
  std::string name, body;
  double radiance = 1.0;  // everywhere in the picture
};
void PrintTo(const FurnaceCase& c, std::ostream* out) {
  *out << c.name;
}

class Furnace : public ::testing::TestWithParam<FurnaceCase> {};

std::string scene(const std::string& body) {
  return "<scene version=\"3.0.0\">" + body + "</scene>";
}

/// Transmittance between the camera and infinity averaged over the picture; by the midpoint rule
/// over the film where `tau(ray)` is the optical thickness in closed form.
double mean_opacity(const TestScene& scene, const std::function<double(const Ray&)>& tau) {
  constexpr int kPoints = 600;
  double sum = 0.0;
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x) {
      const Vec2 film = (Vec2(x, y) + 0.5f) / float(kPoints);
      sum -= std::expm1(-tau(scene.loaded().camera->ray(film, Vec2(0.5f)).ray));
    }
  return sum / (kPoints * kPoints);
}

/// The same as an average of the scene's own transmittance at independent points.
RunningMean sampled_opacity(const TestScene& scene) {
  const Camera& camera = *scene.loaded().camera;
  const Medium* medium =
      scene.loaded().scene->medium_at(camera.ray(Vec2(0.5f), Vec2(0.5f)).ray.o).medium;
  RunningMean mean_of;
  Rng rng(99);
  for (int i = 0; i < 60000; ++i) {
    const CameraRay ray = camera.ray(rng.next_vec2(), Vec2(0.5f));
    mean_of.add(1.0 - mean(scene.loaded().scene->transmittance(ray.ray, ray.t_max, medium, rng)));
  }
  return mean_of;
}

TEST_P(Furnace, IsOneEverywhere) {
  const TestScene test(scene(GetParam().body), write_files);
  const Rendered picture = render_path(test, kReplications);
  constexpr double kRounding = 5e-6;  // of products of a thousand weights that are nearly 1
  for (const Channel channel : {kRed, kGreen, kBlue}) {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        EXPECT_TRUE(agrees(picture.pixel(channel, x, y), GetParam().radiance, kRounding))
            << "channel " << channel << " of pixel (" << x << ", " << y << ")";
    EXPECT_TRUE(agrees(picture.whole(channel), GetParam().radiance, kRounding))
        << "channel " << channel;
  }
  EXPECT_TRUE(agree(picture.whole(kOpacity), sampled_opacity(test), kRounding));
}

std::vector<FurnaceCase> media_in_shapes() {
  return {
      {"ThinBackwardFogInSphere", homogeneous("0.3", -0.9) + kSphere + kFar},
      {"IsotropicFogInSphere", homogeneous("2", 0.0) + kSphere + kFar},
      {"DenseFogInSphere", homogeneous("12", 0.5) + kSphere + kFar},
      {"ForwardFogInSphere", homogeneous("5", 0.95) + kSphere + kFar},
      {"ColouredFogInSphere", homogeneous("0.5, 2, 6", 0.5) + kSphere + kFar},
      {"CameraInsideSphere", homogeneous("1.5, 1, 0.5", -0.9) + kSphere + kWithin},
      {"CameraInsideDenseSphere", homogeneous("8", 0.95) + kSphere + kWithin},
      {"BackwardFogInCube", homogeneous("6", -0.9) + kSkewedCube + kFar},
      {"ForwardFogInCube", homogeneous("2", 0.95) + kSkewedCube + kFar},
      {"ColouredFogInCube", homogeneous("9, 3, 1", 0.0) + kSkewedCube + kFar},
      {"FogInTorus", homogeneous("4", 0.0) + kTorus + kFar},
      {"ColouredFogInTorus", homogeneous("3, 0.2, 7", 0.95) + kTorus + kFar},
      {"FogInTetrahedron", homogeneous("3", 0.5) + kTetrahedron + kFar},
      {"CameraInsideTetrahedron", homogeneous("3, 5, 2", 0.0) + kTetrahedron + kWithin},
      {"FogInCylinder", homogeneous("2.5", 0.5) + kCylinder + kFar},
      {"CameraInsideCylinder", homogeneous("0.5, 1, 4", -0.9) + kCylinder + kWithin},
      {"FogInFog", homogeneous("6", 0.0) + kNested + kFar},
      {"CameraInsideFogInFog", homogeneous("1, 3, 5", 0.95) + kNested + kWithin},
      {"ThinGrid", heterogeneous("grey.vol", 0.5, 0.0) + kNoHull + kFar},
      {"DenseBackwardGrid", heterogeneous("grey.vol", 10, -0.9) + kNoHull + kFar},
      {"CameraInsideForwardGrid", heterogeneous("grey.vol", 4, 0.95) + kNoHull + kWithin},
      {"GridInSphere", heterogeneous("grey.vol", 3, 0.5) + kSphere + kFar},
      {"GridInTorus", heterogeneous("grey.vol", 8, 0.0) + kTorus + kFar},
      {"GridInCylinder", heterogeneous("grey.vol", 2, 0.95) + kCylinder + kFar},
      {"GridInFog", heterogeneous("grey.vol", 5, 0.0) + kNested + kFar},
      {"ThinColouredGrid", heterogeneous("colour.vol", 0.4, -0.9) + kNoHull + kFar},
      {"ColouredGrid", heterogeneous("colour.vol", 2, 0.5) + kNoHull + kFar},
      {"DenseColouredGrid", heterogeneous("colour.vol", 6, 0.0) + kNoHull + kFar},
      {"CameraInsideColouredGrid", heterogeneous("colour.vol", 2, 0.95) + kNoHull + kWithin},
      {"ColouredGridInCube", heterogeneous("colour.vol", 2, 0.0) + kSkewedCube + kFar},
  };
}

/// Materials that reflect or let through all light.
std::vector<FurnaceCase> materials() {
  const std::string white = "<rgb name=\"reflectance\" value=\"1, 1, 1\"/>";
  const auto ball = [](const std::string& bsdf, const std::string& media = "") {
    return "<shape type=\"sphere\"><float name=\"radius\" value=\"0.6\"/>" + bsdf + media +
           "</shape>";
  };
  const std::string diffuse = "<bsdf type=\"diffuse\">" + white + "</bsdf>";
  const std::string glass = "<bsdf type=\"dielectric\"/>";
  const std::string in_fog =
      "<shape type=\"cube\"><bsdf type=\"null\"/><ref name=\"interior\" id=\"m\"/></shape>";
  const std::string fog_outside = "<ref name=\"exterior\" id=\"m\"/>";
  const std::string fog_inside = "<ref name=\"interior\" id=\"m\"/>";
  const std::string sheet =
      "<transform name=\"to_world\"><rotate x=\"1\" y=\"0.3\" angle=\"50\"/></transform>";
  return {
      {"WhiteBall", ball(diffuse) + kFar},
      {"WhiteBallInFog", homogeneous("2", 0.5) + in_fog + ball(diffuse, fog_outside) + kFar},
      {"WhiteBallInGrid", heterogeneous("grey.vol", 4, 0.0) + ball(diffuse) + kFar},
      {"GlassBall", ball(glass) + kFar},
      {"GlassBallFilledWithFog", homogeneous("2, 4, 1", 0.5) + ball(glass, fog_inside) + kFar},
      {"GlassBallInFog", homogeneous("1.5", 0.0) + in_fog + ball(glass, fog_outside) + kFar},
      {"GlassBallFilledWithGrid",
       heterogeneous("grey.vol", 6, 0.5) + ball(glass, fog_inside) + kFar},
      // Light that enters a glass is squeezed into a narrower cone: radiance grows with n^2.
      {"CameraInsideGlassBallInGrid",
       heterogeneous("colour.vol", 1, 0.0) +
           ball("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"1.5\"/><float "
                "name=\"ext_ior\" value=\"1\"/></bsdf>") +
           kWithin,
       1.5 * 1.5},
      {"GlassTorusInFog",
       homogeneous("1", 0.95) + in_fog +
           "<shape type=\"obj\"><string name=\"filename\" value=\"torus.obj\"/><boolean "
           "name=\"face_normals\" value=\"true\"/><transform "
           "name=\"to_world\"><scale value=\"0.8\"/></transform>" +
           glass + fog_outside + "</shape>" + kFar},
      {"ThinGlassSheetInFog", homogeneous("1", 0.0) + in_fog + "<shape type=\"rectangle\">" +
                                  sheet + "<bsdf type=\"thindielectric\"/></shape>" + kFar},
      {"NullBall", ball("<bsdf type=\"null\"/>") + kFar},
      {"MirrorBallInFog", homogeneous("1, 2, 3", -0.9) + in_fog +
                              ball("<bsdf type=\"conductor\"/>", fog_outside) + kFar},
      {"WhitePlasticBallInFog",
       homogeneous("2", 0.0) + in_fog +
           ball("<bsdf type=\"plastic\"><rgb name=\"diffuse_reflectance\" value=\"1, 1, 1\"/>"
                "</bsdf>",
                fog_outside) +
           kFar},
      {"WhiteSheetInFog", homogeneous("1", 0.5) + in_fog + "<shape type=\"rectangle\">" + sheet +
                              "<bsdf type=\"twosided\">" + diffuse + "</bsdf></shape>" + kFar},
  };
}

/// Lights of radiance 1 in place of a uniform sky or inside it: radiance 1 all the same.
std::vector<FurnaceCase> lights() {
  const auto emitting = [](const std::string& type, const std::string& inside) {
    return "<shape type=\"" + type + "\">" + inside + "<emitter type=\"area\"/></shape>";
  };
  const std::string inward = "<boolean name=\"flip_normals\" value=\"true\"/>";
  const std::string large = "<transform name=\"to_world\"><scale value=\"5\"/></transform>";
  return {
      {"InsideGlowingSphere",
       homogeneous("2, 4, 1", 0.5) + kSphere +
           emitting("sphere", inward + "<float name=\"radius\" value=\"6\"/>") + kFar},
      {"InsideGlowingCube",
       heterogeneous("grey.vol", 3, 0.5) + emitting("cube", inward + large) + kFar},
      {"UnderWhiteMap", homogeneous("2", 0.5) + kSphere +
                            "<emitter type=\"envmap\"><string name=\"filename\" "
                            "value=\"white.exr\"/></emitter>" +
                            kFar},
      {"GlowingBallInFog",
       homogeneous("1.5", 0.0) +
           "<shape type=\"cube\"><bsdf type=\"null\"/><ref name=\"interior\" id=\"m\"/></shape>" +
           emitting("sphere",
                    "<float name=\"radius\" value=\"0.4\"/><ref name=\"exterior\" "
                    "id=\"m\"/>") +
           kEnvironment + kFar},
      {"GlowingTetrahedronInGrid",
       heterogeneous("colour.vol", 2, 0.5) +
           emitting("ply",
                    "<string name=\"filename\" value=\"tetrahedron.ply\"/><transform "
                    "name=\"to_world\"><scale value=\"0.4\"/></transform>") +
           kEnvironment + kFar},
      {"GlowingCanInFog",
       homogeneous("0.5, 2, 1", -0.9) +
           "<shape type=\"cube\"><bsdf type=\"null\"/><ref name=\"interior\" id=\"m\"/></shape>" +
           emitting("cylinder",
                    "<float name=\"radius\" value=\"0.3\"/><point name=\"p0\" value=\"0, 0, "
                    "-0.5\"/><point name=\"p1\" value=\"0, 0, 0.5\"/>") +
           emitting("disk",
                    "<transform name=\"to_world\"><scale value=\"0.3\"/><translate "
                    "z=\"0.5\"/></transform>") +
           emitting("disk",
                    "<transform name=\"to_world\"><scale value=\"0.3\"/><rotate x=\"1\" "
                    "angle=\"180\"/><translate z=\"-0.5\"/></transform>") +
           kEnvironment + kFar},
  };
}

std::vector<FurnaceCase> with_environment(std::vector<FurnaceCase> cases) {
  for (FurnaceCase& c : cases) c.body += kEnvironment;
  return cases;
}

std::string name_of(const ::testing::TestParamInfo<FurnaceCase>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Media, Furnace, ::testing::ValuesIn(with_environment(media_in_shapes())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Materials, Furnace, ::testing::ValuesIn(with_environment(materials())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Lights, Furnace, ::testing::ValuesIn(lights()), name_of);

/// Where the sky is hidden, what is seen of it is what scattered: added to a sky of radiance 1 that
/// shines through what the opacity leaves, it is 1 again.
class HiddenSky : public ::testing::TestWithParam<FurnaceCase> {};

TEST_P(HiddenSky, RadianceIsOpacity) {
  const TestScene test(
      scene(GetParam().body + "<integrator type=\"volpath\"><boolean name=\"hide_emitters\" "
                              "value=\"true\"/></integrator>"),
      write_files);
  const Rendered picture = render_path(test, kReplications);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      EXPECT_TRUE(agree(picture.pixel(kGreen, x, y), picture.pixel(kOpacity, x, y), 5e-6))
          << "pixel (" << x << ", " << y << ")";
  EXPECT_TRUE(agree(picture.whole(kGreen), picture.whole(kOpacity), 5e-6));
  EXPECT_GT(picture.whole(kOpacity).mean(), 0.05);
  EXPECT_LT(picture.whole(kOpacity).mean(), 0.95);
}

std::vector<FurnaceCase> grey_bodies() {
  const std::string ball = "<shape type=\"sphere\"><float name=\"radius\" value=\"0.5\"/>";
  const std::string sheet =
      "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.7\"/><rotate "
      "x=\"1\" angle=\"40\"/></transform>";
  return {
      {"Fog", homogeneous("1.5", 0.5) + kSphere + kFar},
      {"Grid", heterogeneous("grey.vol", 2, 0.0) + kNoHull + kFar},
      {"GlassBallInFog", homogeneous("0.7", 0.0) + kSkewedCube + ball +
                             "<bsdf type=\"dielectric\"/><ref name=\"interior\" id=\"m\"/>"
                             "</shape>" +
                             kFar},
      {"ThinGlassInGrid", heterogeneous("grey.vol", 1, 0.6) + sheet +
                              "<bsdf type=\"thindielectric\"/></shape>" + kFar},
      {"CameraInsideFog", homogeneous("0.8", 0.8) + kSphere + kWithin},
  };
}

INSTANTIATE_TEST_SUITE_P(, HiddenSky, ::testing::ValuesIn(with_environment(grey_bodies())),
                         name_of);

double chord_of_unit_sphere(const Ray& ray) {
  const glm::dvec3 o(ray.o), d(ray.d);
  const double b = glm::dot(o, d), discriminant = b * b - glm::dot(o, o) + 1.0;
  if (discriminant <= 0.0) return 0.0;
  const double far = -b + std::sqrt(discriminant), near = -b - std::sqrt(discriminant);
  return std::max(0.0, far - std::max(near, 0.0));
}

double chord_of_unit_cube(const Ray& ray) {
  const glm::dvec3 o(ray.o), inverse = 1.0 / glm::dvec3(ray.d);
  const glm::dvec3 a = (-1.0 - o) * inverse, b = (1.0 - o) * inverse;
  const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
  return std::max(0.0, std::min({far.x, far.y, far.z}) - std::max({near.x, near.y, near.z, 0.0}));
}

TEST(Opacity, OfUniformFogInSphereAndCubeIsBeerLambert) {
  const std::string cube = hull("cube", "");
  const std::string grid_cube =
      "<medium type=\"heterogeneous\"><volume name=\"sigma_t\" type=\"constvolume\"><float "
      "name=\"value\" value=\"0.7\"/><transform name=\"to_world\"><scale value=\"2\"/><translate "
      "x=\"-1\" y=\"-1\" z=\"-1\"/></transform></volume></medium>";
  struct Case {
    std::string body;
    double sigma_t;
    double (*chord)(const Ray&);
  };
  for (const Case& c : {Case{homogeneous("0.7", 0.0) + kSphere, 0.7, chord_of_unit_sphere},
                        Case{homogeneous("0.7", 0.0) + cube, 0.7, chord_of_unit_cube},
                        Case{homogeneous("20", 0.0) + cube, 20.0, chord_of_unit_cube},
                        Case{grid_cube, 0.7, chord_of_unit_cube}}) {
    for (const std::string& sensor : {kFar, kWithin}) {
      // One event at most: only the opacity is looked at.
      const TestScene test(scene(c.body + sensor +
                                 "<integrator type=\"volpath\"><integer "
                                 "name=\"max_depth\" value=\"1\"/></integrator>"));
      const Rendered picture = render_path(test, 64);
      const double want =
          mean_opacity(test, [&](const Ray& ray) { return c.sigma_t * c.chord(ray); });
      EXPECT_TRUE(agrees(picture.whole(kOpacity), want, 1e-6)) << c.body;
    }
  }
}

}  // namespace
}  // namespace brume::test
