// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdio>

#include "core/sampler.h"
#include "film/film.h"
#include "render/interrupt.h"

namespace brume {
namespace {

constexpr std::uint32_t kTileSize = 8;  // [pixel]

/// Says when to stop, to many threads.
class StopRule {
 public:
  explicit StopRule(double seconds) : limit_(seconds) {}

  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  bool stops() {
    if (!has_stopped() && !interrupt_requested() && elapsed() < limit_) return false;
    stopped_.store(true, std::memory_order_relaxed);
    return true;
  }
  /// Whether `stops` has ever said so.
  bool has_stopped() const { return stopped_.load(std::memory_order_relaxed); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double limit_;  // [s]
  std::atomic<bool> stopped_{false};
};

/// Samples `first` to `end` of every pixel of a tile. Pixels that the stop rule forestalls keep
/// fewer samples.
void render_tile(const SampleFunction& sample, std::uint32_t tile, std::uint32_t first,
                 std::uint32_t end, StopRule& rule, Progress& progress, Film& film) {
  const std::uint32_t tiles_across = (film.width() + kTileSize - 1) / kTileSize;
  const std::uint32_t left = tile % tiles_across * kTileSize;
  const std::uint32_t top = tile / tiles_across * kTileSize;
  for (std::uint32_t y = top; y < std::min(top + kTileSize, film.height()); ++y) {
    for (std::uint32_t x = left; x < std::min(left + kTileSize, film.width()); ++x) {
      if (rule.stops()) return;
      for (std::uint32_t i = first; i < end; ++i) film.add(x, y, sample(x, y, i));
      progress.add(end - first);
    }
  }
}

/// Samples of the next pass: 1, 1, 2, 4, 8, then whole replications. Short passes, which cost
/// their overhead more often, are followed by ones of twice the length.
std::uint32_t next_pass(std::uint32_t done, std::uint32_t last_pass, double last_seconds) {
  constexpr double kShortPass = 0.5;  // [s]
  if (done < Sampler::kReplication) return std::max(done, 1u);
  const std::uint32_t whole = std::max(last_pass, Sampler::kReplication);
  if (last_pass < Sampler::kReplication) return whole;
  return last_seconds < kShortPass ? 2 * whole : whole;
}

RenderResult summarize(const Film& film, StopReason reason, double seconds) {
  std::uint32_t fewest = RenderSettings::kUnlimited;
  double sum = 0.0;
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      fewest = std::min(fewest, film.samples(x, y));
      sum += film.samples(x, y);
    }
  return {.reason = reason,
          .seconds = seconds,
          .min_spp = fewest,
          .mean_spp = sum / (double(film.width()) * film.height())};
}

}  // namespace

RenderResult render(const SampleFunction& sample, const RenderSettings& settings, Film& film) {
  assert(settings.spp > 0 && film.width() > 0 && film.height() > 0);
  const int threads =
      settings.threads > 0 ? settings.threads : oneapi::tbb::info::default_concurrency();
  // The arena alone would not get more threads than the machine has.
  const oneapi::tbb::global_control allow(oneapi::tbb::global_control::max_allowed_parallelism,
                                          std::size_t(threads));
  oneapi::tbb::task_arena arena(threads);

  StopRule rule(settings.seconds);
  const bool unlimited = settings.spp == RenderSettings::kUnlimited;
  Progress progress(settings.progress,
                    {.pixels = std::uint64_t(film.width()) * film.height(),
                     .samples = 0,
                     .target_spp = unlimited ? double(kInfinity) : double(settings.spp),
                     .seconds = 0.0,
                     .seconds_limit = settings.seconds},
                    stderr);

  const std::uint32_t tiles =
      ((film.width() + kTileSize - 1) / kTileSize) * ((film.height() + kTileSize - 1) / kTileSize);
  std::uint32_t done = 0, pass = 0;
  double pass_seconds = 0.0;
  while (done < settings.spp && !rule.stops()) {
    pass = std::min(next_pass(done, pass, pass_seconds), settings.spp - done);
    const double begin = rule.elapsed();
    arena.execute([&] {
      oneapi::tbb::parallel_for(0u, tiles, [&](std::uint32_t tile) {
        render_tile(sample, tile, done, done + pass, rule, progress, film);
      });
    });
    pass_seconds = rule.elapsed() - begin;
    done += pass;
  }
  const StopReason reason = !rule.has_stopped()     ? StopReason::kSampleCount
                            : interrupt_requested() ? StopReason::kInterrupted
                                                    : StopReason::kTimeLimit;
  return summarize(film, reason, rule.elapsed());
}

}  // namespace brume
