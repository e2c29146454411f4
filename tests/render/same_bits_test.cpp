// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>

#include "film/develop.h"
#include "render/render.h"
#include "support/render_scene.h"
#include "support/scene_files.h"

namespace brume::test {
namespace {

/// Fog that fills the world around a grid and a glass ball filled with a coloured medium: every
/// kind of tracking, closed form included.
const char* const kScene = R"(<scene version="3.0.0">
  <medium type="homogeneous">
    <float name="sigma_t" value="0.15"/>
    <phase type="hg"><float name="g" value="0.6"/></phase>
  </medium>
  <medium type="heterogeneous" id="cloud">
    <volume name="sigma_t" type="gridvolume">
      <string name="filename" value="cloud.vol"/>
      <transform name="to_world"><translate x="-1.2" y="-0.5" z="-0.5"/></transform>
    </volume>
    <rgb name="albedo" value="0.99, 0.97, 0.95"/>
  </medium>
  <medium type="homogeneous" id="ink">
    <rgb name="sigma_t" value="3, 1, 0.4"/>
    <rgb name="albedo" value="0.2, 0.6, 0.9"/>
  </medium>
  <shape type="cube">
    <transform name="to_world"><scale value="0.5"/><translate x="-0.7"/></transform>
    <bsdf type="null"/>
    <ref name="interior" id="cloud"/>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.7, 0, 0"/><float name="radius" value="0.6"/>
    <bsdf type="dielectric"/>
    <ref name="interior" id="ink"/>
  </shape>
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="4"/></transform>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><rotate x="1" angle="90"/><translate y="3.5"/></transform>
    <emitter type="area"><rgb name="radiance" value="20, 18, 15"/></emitter>
  </shape>
  <sensor type="thinlens">
    <float name="fov" value="40"/>
    <float name="aperture_radius" value="0.05"/><float name="focus_distance" value="3.5"/>
    <transform name="to_world">
      <lookat origin="0, 0.5, 3.5" target="0, 0, 0" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="37"/><integer name="height" value="26"/>
    </film>
  </sensor>
</scene>)";

/// A closed room full of fog in which pixels share light paths.
const char* const kRoom = R"(<scene version="3.0.0">
  <medium type="homogeneous">
    <rgb name="sigma_t" value="0.3, 0.4, 0.5"/>
    <phase type="hg"><float name="g" value="0.4"/></phase>
  </medium>
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="2"/></transform>
  </shape>
  <shape type="sphere">
    <point name="center" value="0.7, -1, -0.5"/><float name="radius" value="0.7"/>
    <bsdf type="roughconductor"><float name="alpha" value="0.3"/></bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><rotate x="1" angle="90"/><translate y="1.9"/></transform>
    <emitter type="area"><rgb name="radiance" value="5, 4, 3"/></emitter>
  </shape>
  <emitter type="point"><point name="position" value="-1, 0.5, -1"/></emitter>
  <sensor type="perspective">
    <float name="fov" value="70"/>
    <transform name="to_world">
      <lookat origin="0.1, 0.2, 1.8" target="0, -0.3, -1" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="29"/><integer name="height" value="22"/>
    </film>
  </sensor>
</scene>)";

/// The developed picture, every layer of it, or the part of it that begins at column `left` and
/// row `top`.
Image rendered(const TestScene& scene, int threads, std::uint32_t spp, std::uint32_t left = 0,
               std::uint32_t top = 0) {
  Film film(std::uint32_t(scene.width()) - left, std::uint32_t(scene.height()) - top,
            {.albedo = true, .depth = true});
  const PathIntegrator integrator(*scene.loaded().scene, *scene.loaded().camera,
                                  scene.loaded().path);
  const auto sample = [&](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                          std::uint32_t turn) {
    const std::uint32_t column = left + x, row = top + y;
    Sampler sampler(0, row * std::uint32_t(scene.width()) + column, index);
    const Vec2 film_point = scene.film_point(int(column), int(row), sampler);
    constexpr std::uint32_t kSpacing = 3;  // of pixels that share light paths
    return integrator.sample(
        film_point, sampler,
        {.seed = turn, .group = row % kSpacing * kSpacing + column % kSpacing});
  };
  render(sample, {.spp = spp, .threads = threads}, film);
  return develop(film);
}

void expect_same_bits(const TestScene& scene) {
  const Image one = rendered(scene, 1, 80);
  for (const int threads : {2, 7}) {
    const Image other = rendered(scene, threads, 80);
    ASSERT_EQ(one.pixels.size(), other.pixels.size());
    EXPECT_EQ(
        std::memcmp(one.pixels.data(), other.pixels.data(), one.pixels.size() * sizeof(float)), 0)
        << threads << " threads";
  }
  // Another number of samples is another picture, so that equal bits say something.
  EXPECT_NE(rendered(scene, 2, 79).pixels, one.pixels);
}

TEST(SameBits, ForOneTwoAndSevenThreads) {
  const TestScene scene(kScene, [](const TemporaryFolder& folder) {
    folder.write("cloud.vol", vol_bytes({12, 12, 12}, 1, [](int x, int y, int z, int) {
                   return (x * y + z) % 7 == 0 ? 25.0 : 2.0;
                 }));
  });
  expect_same_bits(scene);
}

TEST(SameBits, ForOneTwoAndSevenThreadsThatShareLightPaths) {
  const TestScene scene(kRoom);
  ASSERT_TRUE(PathIntegrator(*scene.loaded().scene, *scene.loaded().camera, scene.loaded().path)
                  .meets_light_paths());
  expect_same_bits(scene);
}

TEST(SameBits, ForAPixelInThePictureAndInAPartOfIt) {
  const TestScene scene(kRoom);
  constexpr std::uint32_t kLeft = 11, kTop = 7;
  const Image whole = rendered(scene, 2, 48), part = rendered(scene, 2, 48, kLeft, kTop);
  const std::size_t channels = whole.channels.size();
  ASSERT_EQ(part.channels.size(), channels);
  for (int y = 0; y < part.height; ++y) {
    const float* of_whole =
        &whole.pixels[(std::size_t(y + int(kTop)) * std::size_t(whole.width) + kLeft) * channels];
    const float* of_part = &part.pixels[std::size_t(y) * std::size_t(part.width) * channels];
    EXPECT_EQ(std::memcmp(of_whole, of_part, std::size_t(part.width) * channels * sizeof(float)), 0)
        << "row " << y;
  }
}

}  // namespace
}  // namespace brume::test
