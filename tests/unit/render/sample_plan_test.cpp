// SPDX-License-Identifier: Apache-2.0
#include "render/sample_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/sampler.h"
#include "film/film.h"
#include "render/render.h"
#include "support/statistics.h"

namespace brume {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 32;

/// A noisy, skewed square on a quiet ground; the mean is 1 everywhere.
bool is_noisy(std::uint32_t x, std::uint32_t y) {
  return x >= 16 && x < 28 && y >= 10 && y < 22;
}

CameraSample spot(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t index) {
  Sampler sampler(seed, y * kWidth + x, index);
  const float u = sampler.next_1d();
  if (!is_noisy(x, y)) return {.L = Rgb(0.99f + 0.02f * u)};
  // One sample in eight is seven times as bright and costs more.
  const bool bright = sampler.rng().next_float() < 0.125f;
  return {.L = Rgb(bright ? 7.0f : 1.0f / 7.0f), .work = 5.0f};
}

std::unique_ptr<const Film> rendered(std::uint64_t seed, const RenderSettings& settings) {
  auto film = std::make_unique<Film>(kWidth, kHeight, FilmLayers{.guide = true});
  render([seed](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                std::uint32_t) { return spot(seed, x, y, index); },
         settings, *film);
  return film;
}

TEST(SamplePlan, RoundsGrowByAnEighth) {
  std::uint32_t blocks = 0;
  for (const std::uint32_t want : {1u,  2u,  3u,  4u,  5u,  6u,  7u,  8u,  9u,  10u, 11u,
                                   12u, 13u, 14u, 15u, 16u, 18u, 20u, 22u, 24u, 27u})
    EXPECT_EQ(blocks = next_round(blocks), want);
  for (int i = 0; i < 400; ++i) {
    const std::uint32_t next = next_round(blocks);
    EXPECT_LE(next, blocks + std::max(blocks / 8, 1u));
    EXPECT_GE(next, blocks);
    blocks = next;
  }
  EXPECT_EQ(next_round(blocks), blocks);  // the last sample index
  EXPECT_GT(std::uint64_t(even_plan(blocks).even), 4'000'000'000u);
}

TEST(SamplePlan, EachRoundKnowsTheOneBefore) {
  std::uint32_t before = 0;
  EXPECT_EQ(round_before(0), 0u);
  for (std::uint32_t blocks = 1; blocks < 100'000; blocks = next_round(blocks)) {
    EXPECT_EQ(round_before(blocks), before);
    before = blocks;
  }
}

TEST(SamplePlan, NoiseThatSamplesTakeFromEachOtherIsNone) {
  // Stratified samples of a steep ramp leave little noise; independent ones of a flat one more.
  const auto ramp_or_noise = [](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                                std::uint32_t) {
    Sampler sampler(1, y * kWidth + x, index);
    const float u = sampler.next_1d();
    return CameraSample{.L = Rgb(x < kWidth / 2 ? 20.0f * u : 5.0f * sampler.rng().next_float())};
  };
  Film film(kWidth, kHeight, {.guide = true});
  render(ramp_or_noise, {.spp = 2 * Sampler::kBlock}, film);
  const SamplePlan plan = adaptive_plan(film, 10);
  const std::size_t row = std::size_t(kHeight / 2) * kWidth;
  EXPECT_GT(plan.samples(row + kWidth - 8), 2 * plan.samples(row + 8));
}

TEST(SamplePlan, NoisyPixelsGetMoreAndNoneIsForgotten) {
  const auto film = rendered(1, {.error = 0.05, .adaptive = true});
  const std::uint32_t noisy = film->samples(22, 16), quiet = film->samples(2, 2);
  EXPECT_GT(noisy, 8 * quiet);
  EXPECT_LE(noisy, 64 * quiet);
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) EXPECT_GE(film->samples(x, y), quiet);
}

TEST(SamplePlan, ReachesTheErrorWithFewerSamples) {
  const auto samples = [](bool adaptive) {
    const auto film = rendered(1, {.error = 0.03, .adaptive = adaptive});
    std::uint64_t sum = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) sum += film->samples(x, y);
    return sum;
  };
  EXPECT_LT(3 * samples(true), samples(false));
}

TEST(SamplePlan, APixelsOwnSamplesDoNotDecideForIt) {
  // However noisy one pixel is, it gets what its neighbours' noise says; they get more for it.
  const auto flat = [](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                       std::uint32_t) -> CameraSample {
    return {.L = Rgb(1.0f + Sampler(1, y * kWidth + x, index).next_1d())};
  };
  const auto with_spike = [&](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                              std::uint32_t turn) {
    if (x != 20 || y != 15) return flat(x, y, index, turn);
    return CameraSample{.L = Rgb(Sampler(1, 7, index).rng().next_float() < 0.1f ? 1e3f : 0.0f)};
  };
  constexpr std::uint32_t kBlocks = 10;
  const auto plan_after_two_rounds = [&](const SampleFunction& sample) {
    Film film(kWidth, kHeight, {.guide = true});
    render(sample, {.spp = 2 * Sampler::kBlock}, film);
    return adaptive_plan(film, kBlocks);
  };
  const SamplePlan without = plan_after_two_rounds(flat), with = plan_after_two_rounds(with_spike);
  const auto at = [](std::uint32_t x, std::uint32_t y) { return std::size_t(y) * kWidth + x; };
  EXPECT_LE(with.samples(at(20, 15)), without.samples(at(20, 15)));
  EXPECT_GT(with.samples(at(21, 15)), 4 * without.samples(at(21, 15)));
  EXPECT_GT(with.samples(at(16, 11)), 4 * without.samples(at(16, 11)));
  EXPECT_LE(with.samples(at(15, 15)), without.samples(at(15, 15)));  // out of reach
}

TEST(SamplePlan, AQuietPictureIsSampledEvenly) {
  Film film(9, 7, {.guide = true});
  render([](std::uint32_t, std::uint32_t, std::uint32_t,
            std::uint32_t) { return CameraSample{.L = Rgb(1.0f)}; },
         {.spp = 32}, film);
  for (const std::uint32_t blocks : {1u, 2u, 50u}) {
    const SamplePlan plan = adaptive_plan(film, blocks);
    for (std::size_t i = 0; i < 9 * 7; ++i) EXPECT_EQ(plan.samples(i), blocks * Sampler::kBlock);
  }
}

TEST(SamplePlan, AdaptiveMeansAreUnbiased) {
  // Skewed noise and few samples: the pixel that decided by its own would stop while it is dark.
  test::RunningMean noisy, quiet, corner;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto film = rendered(seed, {.error = 0.12, .adaptive = true});
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        (is_noisy(x, y) ? noisy : quiet).add(film->mean(x, y).r);
    corner.add(film->mean(16, 10).r);
  }
  EXPECT_TRUE(test::agrees(noisy, 1.0));
  EXPECT_TRUE(test::agrees(quiet, 1.0));
  EXPECT_TRUE(test::agrees(corner, 1.0));
  EXPECT_LT(noisy.standard_error(), 0.004);
}

}  // namespace
}  // namespace brume
