// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "core/sampler.h"
#include "film/develop.h"
#include "film/film.h"
#include "film/picture_error.h"
#include "render/interrupt.h"

namespace brume {
namespace {

/// Depends on all that it is given.
CameraSample noise(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
  Sampler sampler(1 + turn, y * 1000 + x, index);
  const Vec2 u = sampler.next_2d();
  return {.L = {u.x, u.y, 1.0f / (1e-3f + u.x)}, .alpha = sampler.next_1d(), .depth = u.y};
}

CameraSample slow(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return noise(x, y, index, turn);
}

Film empty_film() {
  return Film(61, 37, {.depth = true, .guide = true});
}

std::vector<float> pixels_after(const RenderSettings& settings) {
  Film film = empty_film();
  render(noise, settings, film);
  return develop(film).pixels;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Settings that end after a fixed number of samples, in every way there is.
std::vector<RenderSettings> deterministic_settings() {
  return {{.spp = 77},
          {.error = 0.5},
          {.error = 0.5, .adaptive = true},
          {.spp = 100, .error = 0.4, .adaptive = true}};
}

TEST(Render, SameBitsForAnyNumberOfThreads) {
  for (RenderSettings settings : deterministic_settings()) {
    settings.threads = 1;
    const std::vector<float> one = pixels_after(settings);
    for (const int threads : {2, 7}) {
      settings.threads = threads;
      EXPECT_TRUE(same_bits(one, pixels_after(settings))) << threads;
    }
  }
}

TEST(Render, InterruptedAndContinuedIsTheSameAsUninterrupted) {
  for (RenderSettings settings : deterministic_settings()) {
    settings.threads = 2;
    const std::vector<float> uninterrupted = pixels_after(settings);
    Film film = empty_film();
    RenderState state;
    StopReason reason = StopReason::kInterrupted;
    int interrupts = -1;
    for (; reason == StopReason::kInterrupted; ++interrupts) {
      const InterruptGuard guard;
      std::atomic<int> left = 12345 * (interrupts + 2);
      const RenderResult result = render(
          [&left](std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
            if (--left == 0) std::raise(SIGINT);
            return noise(x, y, index, turn);
          },
          settings, film, state);
      state = result.state;
      reason = result.reason;
    }
    EXPECT_GE(interrupts, 3);
    EXPECT_TRUE(same_bits(uninterrupted, develop(film).pixels));
  }
}

TEST(Render, AskedForMoreItDoesTheSameFirst) {
  for (const bool adaptive : {false, true}) {
    Film film = empty_film();
    const RenderResult half = render(noise, {.error = 0.6, .adaptive = adaptive}, film);
    EXPECT_EQ(half.reason, StopReason::kErrorTarget);
    render(noise, {.error = 0.4, .adaptive = adaptive}, film, half.state);
    EXPECT_TRUE(
        same_bits(develop(film).pixels, pixels_after({.error = 0.4, .adaptive = adaptive})));
  }
}

TEST(Render, ErrorTargetEndsTheRenderSoonAfterItIsReached) {
  for (const bool adaptive : {false, true}) {
    Film film = empty_film();
    const RenderResult result = render(noise, {.error = 0.4, .adaptive = adaptive}, film);
    EXPECT_EQ(result.reason, StopReason::kErrorTarget);
    EXPECT_LT(picture_error(film).upper_bound, 0.4);
    EXPECT_GT(picture_error(film).upper_bound, 0.8 * 0.4);
  }
}

TEST(Render, SavesCheckpointsWhileSamplesRest) {
  Film film(64, 64);
  std::atomic<int> running = 0, disturbed = 0;
  int checkpoints = 0;
  double seconds = 0.0;
  const RenderSettings settings{.seconds = 1.0,
                                .threads = 2,
                                .save_checkpoint =
                                    [&](const RenderState& state) {
                                      ++checkpoints;
                                      disturbed += running;
                                      EXPECT_GT(state.seconds, seconds);
                                      seconds = state.seconds;
                                    },
                                .checkpoint_interval = 0.1};
  const RenderResult result = render(
      [&](std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
        ++running;
        const CameraSample sample = slow(x, y, index, turn);
        --running;
        return sample;
      },
      settings, film);
  EXPECT_EQ(result.reason, StopReason::kTimeLimit);
  EXPECT_GE(checkpoints, 3);
  EXPECT_LE(checkpoints, 10);
  EXPECT_EQ(disturbed, 0);
}

TEST(Render, EveryPixelGetsItsSamplesInOrder) {
  for (const std::uint32_t spp : {1u, 3u, 16u, 100u}) {
    Film film(20, 9);
    std::vector<std::uint32_t> next(20 * 9, 0);
    std::atomic<int> out_of_order = 0;
    const RenderResult result = render(
        [&](std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
          if (next[y * 20 + x]++ != index) ++out_of_order;
          return noise(x, y, index, turn);
        },
        {.spp = spp, .threads = 4}, film);
    EXPECT_EQ(out_of_order, 0);
    EXPECT_EQ(next, std::vector<std::uint32_t>(20 * 9, spp));
    EXPECT_EQ(result.reason, StopReason::kSampleCount);
    EXPECT_EQ(result.min_spp, spp);
    EXPECT_EQ(result.mean_spp, spp);
  }
}

TEST(Render, PassesLeaveThePictureEven) {
  // Between passes all pixels have the same count: seen from any pixel, no other is more than one
  // pass ahead, and the first passes are short.
  Film film(16, 16);
  std::uint32_t furthest = 0;
  const auto sample = [&](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                          std::uint32_t turn) {
    furthest = std::max(furthest, index);
    const std::uint32_t pass_end = index < 1   ? 1
                                   : index < 2 ? 2
                                   : index < 4 ? 4
                                   : index < 8 ? 8
                                               : 16;
    EXPECT_LT(furthest, pass_end);
    return noise(x, y, index, turn);
  };
  render(sample, {.spp = 16, .threads = 1}, film);
}

TEST(Render, PixelsGoOnInTurns) {
  // One block in each, if all get as many; by their share of the round, if not.
  for (const bool adaptive : {false, true}) {
    Film film = empty_film();
    const std::size_t pixels = std::size_t(film.width()) * film.height();
    std::vector<std::uint32_t> latest(pixels, 0);
    std::atomic<int> uneven = 0, backward = 0;
    std::atomic<std::uint32_t> furthest = 0;
    const auto sample = [&](std::uint32_t x, std::uint32_t y, std::uint32_t index,
                            std::uint32_t turn) {
      if (turn != index / Sampler::kBlock) ++uneven;
      std::uint32_t& before = latest[y * film.width() + x];
      if (turn < before || turn < furthest) ++backward;
      before = turn;
      furthest = turn;
      return noise(x, y, index, turn);
    };
    const RenderResult result = render(sample, {.error = 0.3, .adaptive = adaptive}, film);
    EXPECT_EQ(backward, 0);
    EXPECT_EQ(uneven > 0, adaptive);
    EXPECT_EQ(furthest + 1, result.state.blocks);
    EXPECT_NEAR(result.mean_spp / (result.state.blocks * Sampler::kBlock), 1.0, 0.1);
  }
}

TEST(Render, UsesAsManyThreadsAsAsked) {
  Film film(64, 64);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  render(
      [&](std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
        return noise(x, y, index, turn);
      },
      {.spp = 1, .threads = 3}, film);
  EXPECT_EQ(seen.size(), 3u);
}

TEST(Render, TimeLimitIsKeptInTheMiddleOfAPass) {
  Film film(64, 64);  // a pass takes ten seconds
  const RenderResult result = render(slow, {.seconds = 0.3, .threads = 2}, film);
  EXPECT_EQ(result.reason, StopReason::kTimeLimit);
  EXPECT_GE(result.state.seconds, 0.3);
  EXPECT_LT(result.state.seconds, 1.3);
  EXPECT_EQ(result.min_spp, 0u);
  EXPECT_GT(result.mean_spp, 0.0);
}

TEST(Render, FirstStopRuleReachedEndsTheRender) {
  Film film(8, 8);
  EXPECT_EQ(render(noise, {.spp = 4, .seconds = 60.0}, film).reason, StopReason::kSampleCount);
  Film other(8, 8);
  const RenderResult timed = render(noise, {.spp = 1u << 30, .seconds = 0.2}, other);
  EXPECT_EQ(timed.reason, StopReason::kTimeLimit);
  EXPECT_GT(timed.min_spp, 16u);
}

TEST(Render, InterruptStopsPromptlyAndKeepsTheSamples) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const InterruptGuard guard;
    Film film(64, 64);
    std::atomic<int> count = 0;
    const RenderResult result = render(
        [&](std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t turn) {
          if (++count == 20) std::raise(signal);
          return slow(x, y, index, turn);
        },
        {.spp = 16, .threads = 2}, film);
    EXPECT_EQ(result.reason, StopReason::kInterrupted);
    EXPECT_LT(result.state.seconds, 1.0);
    EXPECT_EQ(result.mean_spp * 64 * 64, count);
  }
  const InterruptGuard fresh;
  EXPECT_FALSE(interrupt_requested());
}

TEST(RenderDeathTest, SecondInterruptEndsTheProgram) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const auto interrupt_twice = [](int first, int second) {
    const InterruptGuard guard;
    std::raise(first);
    std::raise(second);
  };
  EXPECT_EXIT(interrupt_twice(SIGINT, SIGINT), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_EXIT(interrupt_twice(SIGTERM, SIGINT), ::testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace brume
