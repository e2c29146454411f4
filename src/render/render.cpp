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

/// A step of a round, in which each pixel goes on by its part of what the round brings it.
struct Turn {
  const SamplePlan &before, &after;  // of the round
  std::uint32_t first, last;         // numbers of the round's turns, `last` not among them
  std::uint32_t number;
  std::uint32_t limit;  // samples of any pixel

  /// Samples that a pixel is to have at the end.
  std::uint32_t samples(std::size_t pixel) const {
    const std::uint32_t begin = before.samples(pixel), end = after.samples(pixel);
    if (end <= begin) return 0;
    const std::uint64_t blocks = (end - begin) / Sampler::kBlock;
    const std::uint64_t done = blocks * (number + 1 - first) / (last - first);
    return std::min(begin + std::uint32_t(done) * Sampler::kBlock, limit);
  }
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
  SamplePlan plan_of(std::uint32_t blocks) const;
  bool finish_round();
  bool finish_turn(const Turn& turn);
  void render_tile(std::uint32_t tile, const Turn& turn);
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

SamplePlan Renderer::plan_of(std::uint32_t blocks) const {
  return settings_.adaptive && blocks > 0 ? adaptive_plan(film_, blocks) : even_plan(blocks);
}

/// Whether the latest round could be brought to its end.
bool Renderer::finish_round() {
  const std::uint32_t first = round_before(state_.blocks), last = state_.blocks;
  const SamplePlan before = plan_of(first), after = plan_of(last);
  Turn turn{before, after, first, last, first, settings_.spp};
  // The picture as a whole is there soon, whatever ends the render.
  if (first == 0)
    for (const std::uint32_t few : {1u, 2u, 4u, 8u}) {
      turn.limit = std::min(few, settings_.spp);
      if (!finish_turn(turn)) return false;
    }
  turn.limit = settings_.spp;
  for (; turn.number < last; ++turn.number)
    if (!finish_turn(turn)) return false;
  return !clock_.has_stopped();
}

/// Whether all pixels got their samples.
bool Renderer::finish_turn(const Turn& turn) {
  const std::uint32_t tiles = ((film_.width() + kTileSize - 1) / kTileSize) *
                              ((film_.height() + kTileSize - 1) / kTileSize);
  for (;;) {
    arena_.execute([&] {
      oneapi::tbb::parallel_for(0u, tiles, [&](std::uint32_t tile) { render_tile(tile, turn); });
    });
    if (clock_.has_stopped()) return false;
    if (!clock_.rests()) return true;
    settings_.save_checkpoint(state());
    clock_.go_on();
  }
}

void Renderer::render_tile(std::uint32_t tile, const Turn& turn) {
  const std::uint32_t tiles_across = (film_.width() + kTileSize - 1) / kTileSize;
  const std::uint32_t left = tile % tiles_across * kTileSize;
  const std::uint32_t top = tile / tiles_across * kTileSize;
  for (std::uint32_t y = top; y < std::min(top + kTileSize, film_.height()); ++y) {
    for (std::uint32_t x = left; x < std::min(left + kTileSize, film_.width()); ++x) {
      const std::uint32_t end = turn.samples(std::size_t(y) * film_.width() + x);
      for (std::uint32_t i = film_.drawn(x, y); i < end;) {
        if (clock_.calls()) return;
        const std::uint32_t first = i;
        for (; i < std::min(end, first + Sampler::kBlock); ++i)
          film_.add(x, y, sample_(x, y, i, turn.number));
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
