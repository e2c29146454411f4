// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/render_scene.h"

namespace brume::test {
namespace {

/// A slab of fog, thick and white, lit from behind; its light has scattered many times.
std::string slab(float g) {
  return R"(<scene version="3.0.0">
  <medium type="homogeneous" id="fog">
    <float name="sigma_t" value="30"/><float name="albedo" value="0.99"/>
    <phase type="hg"><float name="g" value=")" +
         std::to_string(g) + R"("/></phase>
  </medium>
  <shape type="cube">
    <transform name="to_world"><scale x="20" y="20" z="0.5"/></transform>
    <bsdf type="null"/><ref name="interior" id="fog"/>
  </shape>
  <emitter type="directional">
    <vector name="direction" value="0, 0, 1"/><float name="irradiance" value="1"/>
  </emitter>
  <sensor type="orthographic">
    <transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="2"/><integer name="height" value="2"/></film>
  </sensor>
</scene>)";
}

RunningMean brightness(float g, const std::string& setting, int samples, int max_depth = -1) {
  EstimatorSettings settings;
  if (!setting.empty()) apply_setting(setting, settings);
  const TestScene scene(slab(g), {}, settings);
  PathSettings path = scene.loaded().path;
  path.max_depth = max_depth;
  const PathIntegrator integrator(*scene.loaded().scene, *scene.loaded().camera, path);
  RunningMean mean;
  for (int i = 0; i < samples; ++i) {
    Sampler sampler(1, 0, std::uint32_t(i), true);
    mean.add(integrator.sample(Vec2(0.5f), sampler).L.g);
  }
  return mean;
}

TEST(Similarity, ReplacesIsotropicScatteringByItself) {
  EXPECT_NEAR(brightness(0.0f, "similarity=1", 640).mean(),
              brightness(0.0f, "light-paths=off", 640).mean(), 1e-6);
}

TEST(Similarity, KeepsWhatDiffuses) {
  // Transport thickness 4.5: light that came through has scattered dozens of times.
  const RunningMean exact = brightness(0.85f, "", 32000);
  const RunningMean similar = brightness(0.85f, "similarity=10", 32000);
  EXPECT_NEAR(
      similar.mean(), exact.mean(),
      0.1 * exact.mean() + kMaxZ * std::hypot(exact.standard_error(), similar.standard_error()));
  // Fog that scatters to all sides without being thinned lets far less light through.
  EXPECT_LT(brightness(0.0f, "", 32000).mean(), 0.5 * exact.mean());
}

TEST(Clamp, LimitsWhatScatteredTwiceAndNothingElse) {
  const double once = brightness(0.5f, "", 6400, 2).mean();
  EXPECT_EQ(brightness(0.5f, "clamp=1e-6", 6400, 2).mean(), once);
  const double all = brightness(0.5f, "", 6400).mean();
  EXPECT_EQ(brightness(0.5f, "clamp=1e6", 6400).mean(), all);
  EXPECT_GT(all, 0.0);
  EXPECT_LT(brightness(0.5f, "clamp=1e-6", 6400).mean(), 0.01 * all + once);
}

}  // namespace
}  // namespace brume::test
