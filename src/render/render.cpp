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
#include "render/sample_plan.h"

namespace brume {
namespace {

constexpr std::uint32_t kTileSize = 8;  // [pixel]

/// Says when to stop or to rest, to many threads.
class Clock {
 public:
  Clock(double limit, double interval) : limit_(limit), interval_(interval), next_rest_(interval) {}

  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  /// Whether threads are to put their work down, for good or for a checkpoint.
  bool calls() {
    if (stopped_.load(std::memory_order_relaxed) || rests_.load(std::memory_order_relaxed))
      return true;
    const double now = elapsed();
    if (interrupt_requested() || now >= limit_)
      stopped_.store(true, std::memory_order_relaxed);
    else if (now >= next_rest_)
      rests_.store(true, std::memory_order_relaxed);
    else
      return false;
    return true;
  }
  bool has_stopped() const { return stopped_.load(std::memory_order_relaxed); }
  bool rests() const { return rests_.load(std::memory_order_relaxed); }
  /// Once all threads rest.
  void go_on() {
    next_rest_ = elapsed() + interval_;
    rests_.store(false, std::memory_order_relaxed);
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double limit_, interval_, next_rest_;  // [s]
  std::atomic<bool> stopped_{false}, rests_{false};
};

class Renderer {
 public:
  Renderer(const SampleFunction& sample, const RenderSettings& settings, Film& film,
           const RenderState& state)
      : sample_(sample),
        settings_(settings),
        film_(film),
        state_(state),
        seconds_before_(state.seconds),
        // The arena alone would not get more threads than the machine has.
        allow_(oneapi::tbb::global_control::max_allowed_parallelism, std::size_t(threads())),
        arena_(threads()),
        clock_(settings.seconds,
               settings.save_checkpoint ? settings.checkpoint_interval : double(kInfinity)),
        progress_(settings.progress, goals(), stderr) {}

  StopReason run();
  RenderState state() const {
    return {.blocks = state_.blocks, .seconds = seconds_before_ + clock_.elapsed()};
  }

 private:
  int threads() const {
    return settings_.threads > 0 ? settings_.threads : oneapi::tbb::info::default_concurrency();
  }
  ProgressState goals() const;
  bool finish_round();
  bool bring_to(const SamplePlan& plan, std::uint32_t limit);
  void render_tile(std::uint32_t tile, const SamplePlan& plan, std::uint32_t limit);
  bool has_all_samples() const;

  const SampleFunction& sample_;
  const RenderSettings& settings_;
  Film& film_;
  RenderState state_;
  double seconds_before_;
  oneapi::tbb::global_control allow_;
  oneapi::tbb::task_arena arena_;
  Clock clock_;
  Progress progress_;
};

std::uint64_t samples_drawn(const Film& film) {
  std::uint64_t sum = 0;
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x) sum += film.drawn(x, y);
  return sum;
}

std::uint32_t least_drawn(const Film& film) {
  std::uint32_t least = RenderSettings::kUnlimited;
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x) least = std::min(least, film.drawn(x, y));
  return least;
}

std::uint32_t most_samples(const SamplePlan& plan) {
  return plan.uneven.empty() ? plan.even
                             : *std::max_element(plan.uneven.begin(), plan.uneven.end());
}

ProgressState Renderer::goals() const {
  const bool unlimited = settings_.spp == RenderSettings::kUnlimited;
  return {.pixels = std::uint64_t(film_.width()) * film_.height(),
          .samples_before = samples_drawn(film_),
          .target_spp = unlimited ? double(kInfinity) : double(settings_.spp),
          .seconds_limit = settings_.seconds,
          .target_error = settings_.error};
}

StopReason Renderer::run() {
  while (finish_round()) {
    if (settings_.error > 0.0 || settings_.progress != ProgressStyle::kQuiet) {
      const PictureError error = picture_error(film_);
      progress_.set_error(error.upper_bound);
      if (error.upper_bound < settings_.error) return StopReason::kErrorTarget;
    }
    const std::uint32_t next = next_round(state_.blocks);
    if (next == state_.blocks || has_all_samples()) return StopReason::kSampleCount;
    state_.blocks = next;
  }
  return interrupt_requested() ? StopReason::kInterrupted : StopReason::kTimeLimit;
}

/// Whether the latest round could be brought to its end.
bool Renderer::finish_round() {
  const SamplePlan plan = settings_.adaptive && state_.blocks > 0
                              ? adaptive_plan(film_, state_.blocks)
                              : even_plan(state_.blocks);
  // The picture as a whole is there soon, whatever ends the render.
  if (state_.blocks == 1)
    for (const std::uint32_t few : {1u, 2u, 4u, 8u})
      if (!bring_to(plan, std::min(few, settings_.spp))) return false;
  // Block by block, as pixels share light paths in a block.
  const std::uint32_t most = std::min(most_samples(plan), settings_.spp);
  for (std::uint32_t end = least_drawn(film_); end < most;) {
    end = std::min((end / Sampler::kBlock + 1) * Sampler::kBlock, most);
    if (!bring_to(plan, end)) return false;
  }
  return !clock_.has_stopped();
}

/// Whether all pixels got the samples of `plan`, up to `limit`.
bool Renderer::bring_to(const SamplePlan& plan, std::uint32_t limit) {
  const std::uint32_t tiles = ((film_.width() + kTileSize - 1) / kTileSize) *
                              ((film_.height() + kTileSize - 1) / kTileSize);
  for (;;) {
    arena_.execute([&] {
      oneapi::tbb::parallel_for(0u, tiles,
                                [&](std::uint32_t tile) { render_tile(tile, plan, limit); });
    });
    if (clock_.has_stopped()) return false;
    if (!clock_.rests()) return true;
    settings_.save_checkpoint(state());
    clock_.go_on();
  }
}

void Renderer::render_tile(std::uint32_t tile, const SamplePlan& plan, std::uint32_t limit) {
  const std::uint32_t tiles_across = (film_.width() + kTileSize - 1) / kTileSize;
  const std::uint32_t left = tile % tiles_across * kTileSize;
  const std::uint32_t top = tile / tiles_across * kTileSize;
  for (std::uint32_t y = top; y < std::min(top + kTileSize, film_.height()); ++y) {
    for (std::uint32_t x = left; x < std::min(left + kTileSize, film_.width()); ++x) {
      const std::uint32_t end = std::min(plan.samples(std::size_t(y) * film_.width() + x), limit);
      for (std::uint32_t i = film_.drawn(x, y); i < end;) {
        if (clock_.calls()) return;
        const std::uint32_t first = i;
        for (; i < std::min(end, first + Sampler::kBlock); ++i) film_.add(x, y, sample_(x, y, i));
        progress_.add(i - first);
      }
    }
  }
}

bool Renderer::has_all_samples() const {
  for (std::uint32_t y = 0; y < film_.height(); ++y)
    for (std::uint32_t x = 0; x < film_.width(); ++x)
      if (film_.drawn(x, y) < settings_.spp) return false;
  return true;
}

}  // namespace

RenderResult render(const SampleFunction& sample, const RenderSettings& settings, Film& film,
                    const RenderState& state) {
  assert(settings.spp > 0 && film.width() > 0 && film.height() > 0);
  assert(!settings.adaptive || film.layers().guide);
  RenderResult result{
      .reason = {}, .state = state, .min_spp = RenderSettings::kUnlimited, .mean_spp = 0.0};
  {
    Renderer renderer(sample, settings, film, state);
    result.reason = renderer.run();
    result.state = renderer.state();
  }
  double sum = 0.0;
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      result.min_spp = std::min(result.min_spp, film.samples(x, y));
      sum += film.samples(x, y);
    }
  result.mean_spp = sum / (double(film.width()) * film.height());
  return result;
}

}  // namespace brume
