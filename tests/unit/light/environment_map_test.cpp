// SPDX-License-Identifier: Apache-2.0
#include "light/environment_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/warp.h"
#include "unit/light/light_laws.h"

namespace brume {
namespace {

/// Direction of the point (u, v) of a map.
Vec3 direction(double u, double v) {
  const double phi = 2.0 * M_PI * u, theta = M_PI * v;
  return Vec3(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
}

/// Rotation about a slanted axis.
glm::dmat4 slanted() {
  const Frame frame(glm::normalize(Vec3(0.3f, 0.8f, -0.5f)));
  return glm::dmat4(glm::dmat3(frame.s, frame.t, frame.n));
}

EnvironmentMap black_but_for(std::size_t column, std::size_t row, const Rgb& value,
                             const glm::dmat4& to_world = glm::dmat4(1.0)) {
  std::vector<Rgb> pixels(16 * 9, Rgb(0.0f));
  pixels[row * 16 + column] = value;
  return {pixels, 16, 9, to_world, 1.0f};
}

EnvironmentMap noise(std::size_t width, std::size_t height, const glm::dmat4& to_world) {
  Rng rng(11);
  std::vector<Rgb> pixels;
  for (std::size_t i = 0; i < width * height; ++i) {
    const float bright = rng.next_float() < 0.1f ? 20.0f : 1.0f;
    pixels.push_back(bright * Rgb(rng.next_float(), rng.next_float(), rng.next_float()));
  }
  return {pixels, width, height, to_world, 1.0f};
}

TEST(EnvironmentMap, HasPixelCentresWhereMitsubaHasThem) {
  const std::size_t width = 16, height = 9;
  std::vector<Rgb> pixels;
  for (std::size_t i = 0; i < width * height; ++i) pixels.emplace_back(i, 2 * i, 1.0f);
  const EnvironmentMap map(pixels, width, height, glm::dmat4(1.0), 2.0f);
  for (std::size_t row = 1; row + 1 < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const Rgb seen = map.radiance(
          direction((double(column) + 0.5) / double(width), double(row) / double(height - 1)));
      EXPECT_LE(max_abs(seen - 2.0f * pixels[row * width + column]), 1e-3f);
    }
  }
  // Seen along -Z is u = 0, the seam; along +X it is u = 1/4.
  const std::size_t horizon = 4 * width;
  EXPECT_NEAR(map.radiance({0, 0, -1}).r, float(horizon + horizon + 15), 1e-3f);
  EXPECT_NEAR(map.radiance({1, 0, 0}).r, float(horizon + 3 + horizon + 4), 1e-3f);
  // Across the seam the picture is continuous.
  EXPECT_NEAR(map.radiance(direction(1e-5, 0.4)).r, map.radiance(direction(-1e-5, 0.4)).r, 0.02f);
}

TEST(EnvironmentMap, IsTurnedWithToWorld) {
  const EnvironmentMap upright = noise(16, 9, glm::dmat4(1.0));
  const EnvironmentMap turned = noise(16, 9, slanted());
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = direction(rng.next_float(), rng.next_float());
    const Vec3 world = glm::mat3(slanted()) * d;
    EXPECT_LE(max_abs(turned.radiance(world) - upright.radiance(d)), 1e-3f);
  }
}

TEST(EnvironmentMap, IsSampledAsSeen) {
  const glm::dmat4 mirror(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1, 0),
                          glm::dvec4(0, 0, 0, 1));
  for (const glm::dmat4& to_world : {glm::dmat4(1.0), slanted(), mirror * slanted()}) {
    EXPECT_TRUE(test::is_sampled_as_seen(noise(16, 9, to_world), {.axis = {0, 1, 0}}));
    EXPECT_TRUE(test::is_sampled_as_seen(noise(1, 2, to_world), {.axis = {0, 1, 0}}));
    EXPECT_TRUE(test::is_sampled_as_seen(noise(2, 3, to_world), {.axis = {0, 1, 0}}));
  }
}

TEST(EnvironmentMap, IsSampledAsSeenWithOneBrightPixel) {
  // In the middle, at the seam, beside a pole, and at a pole.
  for (const auto& [column, row] :
       std::vector<std::pair<std::size_t, std::size_t>>{{5, 4}, {15, 3}, {0, 1}, {7, 0}, {3, 8}}) {
    EXPECT_TRUE(test::is_sampled_as_seen(black_but_for(column, row, {1000, 1, 1}),
                                         {.axis = {0, 1, 0}, .pdf_tolerance = 1e-2f}))
        << column << " " << row;
  }
}

TEST(EnvironmentMap, HasAPositiveDensityWhereverItIsNotBlack) {
  Rng rng(4);
  for (std::size_t row = 0; row < 9; ++row) {
    const EnvironmentMap map = black_but_for(15, row, {0, 0, 1e-3f});
    for (int i = 0; i < 20000; ++i) {
      const Vec3 d = sample_uniform_sphere(rng.next_vec2());
      ASSERT_EQ(map.pdf(d) > 0.0f, !is_black(map.radiance(d)));
    }
  }
}

TEST(EnvironmentMap, IrradiatesAsQuadratureSays) {
  const Vec3 n = glm::normalize(Vec3(0.2f, 0.7f, -0.4f));
  const std::vector<EnvironmentMap> maps{noise(16, 9, glm::dmat4(1.0)), noise(16, 9, slanted()),
                                         black_but_for(5, 2, {1, 10, 100}),
                                         black_but_for(5, 0, {1, 10, 100})};
  for (const EnvironmentMap& map : maps) {
    const auto E = test::irradiance(test::sampler_of(map), n, 200000);
    const glm::dvec3 want =
        test::irradiance_by_quadrature([&](const Vec3& d) { return map.radiance(d); }, n, 400);
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(test::agrees(E[c], want[c], 1e-4 * want[c]));
  }
}

TEST(EnvironmentMap, IsSampledWithLittleNoise) {
  // A grey picture is sampled all but perfectly: every sample carries the whole flux.
  std::vector<Rgb> pixels;
  Rng rng(6);
  for (int i = 0; i < 64 * 33; ++i) pixels.emplace_back(rng.next_float());
  const EnvironmentMap map(pixels, 64, 33, glm::dmat4(1.0), 1.0f);
  test::RunningMean flux;
  for (int i = 0; i < 100000; ++i) flux.add(map.sample(Vec3(0.0f), rng.next_vec2())->weight.g);
  const double deviation = flux.standard_error() * std::sqrt(double(flux.count()));
  EXPECT_LT(deviation / flux.mean(), 0.02);
}

TEST(EnvironmentMap, IsAsImportantAsItsFluenceAboveTheMean) {
  const auto importance = [](const EnvironmentMap& map) { return map.importance(Vec3(0.0f)); };
  EXPECT_EQ(importance({std::vector<Rgb>(64 * 33, Rgb(0.1f, 0.7f, 0.3f)), 64, 33, slanted(), 3.0f}),
            0.0f);

  // One half of the sphere 2, the other 6. The two columns of cells between them are as bright as
  // the mean, and half of each belonged to the bright half.
  const std::size_t width = 512, height = 33;
  std::vector<Rgb> pixels;
  for (std::size_t i = 0; i < width * height; ++i)
    pixels.emplace_back(i % width < width / 2 ? 2.0f : 6.0f);
  EXPECT_NEAR(importance({pixels, width, height, slanted(), 1.0f}),
              2.0 * 2.0 * M_PI * (1.0 - 2.0 / width), 1e-3);
  EXPECT_EQ(importance(black_but_for(0, 0, Rgb(0.0f))), 0.0f);
}

TEST(EnvironmentMap, WithoutLightGivesNone) {
  const EnvironmentMap map = black_but_for(0, 0, Rgb(0.0f));
  EXPECT_FALSE(map.sample(Vec3(0.0f), {0.4f, 0.9f}));
  EXPECT_EQ(map.pdf({0, 1, 0}), 0.0f);
  EXPECT_TRUE(is_black(map.radiance({0, 1, 0})));
}

TEST(EnvironmentMap, LooksUpTheAxesExactly) {
  const EnvironmentMap map = noise(64, 33, glm::dmat4(1.0));
  for (const Vec3& d : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1),
                        Vec3(0, 0, -1), Vec3(-0.0f, 1, -0.0f), Vec3(-0.0f, 0, -1)}) {
    EXPECT_TRUE(is_finite_and_non_negative(map.radiance(d)));
    EXPECT_GT(map.pdf(d), 0.0f);
  }
}

}  // namespace
}  // namespace brume
