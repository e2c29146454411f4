// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/render_scene.h"
#include "support/scene_files.h"

namespace brume::test {
namespace {

/// Light that scatters close to a lamp of no size has no bound. If only the first flights look for
/// it there, it is found by luck after more scatterings, and single samples of these seeds are 2000
/// and 6000 times the mean.
TEST(NearLights, LightThatScatteredOftenHasNoOutliers) {
  const TestScene scene(R"(
    <scene version="3.0.0">
      <medium type="homogeneous">
        <rgb name="sigma_t" value="0.05"/><rgb name="albedo" value="0.99"/>
      </medium>
      <emitter type="point">
        <point name="position" value="0, 0, 0"/><rgb name="intensity" value="1"/>
      </emitter>)" + perspective("3, 1, 10", "3, 1, 0", 5, 1) +
                        "</scene>");
  const PathIntegrator integrator(*scene.loaded().scene, *scene.loaded().camera,
                                  scene.loaded().path);
  constexpr int kSamples = 1 << 16;
  for (const std::uint64_t seed : {3u, 10u}) {
    double sum = 0.0, sum_of_squares = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      Sampler sampler(seed, 0, std::uint32_t(i), true);
      const Vec2 film = scene.film_point(0, 0, sampler);
      const double L = luminance(integrator.sample(film, sampler).L);
      sum += L;
      sum_of_squares += L * L;
    }
    EXPECT_LT(kSamples * sum_of_squares / (sum * sum), 6.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace brume::test
