// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <limits>
#include <mutex>
#include <thread>

#include "render/progress_line.h"

namespace brume {

enum class ProgressStyle {
  kQuiet,  // nothing
  kPlain,  // a line now and then
  kBar,    // one line of a terminal, redrawn
};

/// A bar when `stream` is a terminal that can redraw a line, plain lines otherwise.
ProgressStyle progress_style_of(std::FILE* stream);

/// Shows how far a render is until it is destroyed, from a thread of its own, so that the clock
/// goes on however slow a sample is.
class Progress {
 public:
  /// `start` holds the goals; `stream` outlives this.
  Progress(ProgressStyle style, const ProgressState& start, std::FILE* stream);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts samples; any thread.
  void add(std::uint64_t samples) { samples_.fetch_add(samples, std::memory_order_relaxed); }
  /// The upper bound of the error that the samples so far give.
  void set_error(double error);

 private:
  void show_until(std::stop_token stop);
  void show(const char* line_end);
  double seconds() const;
  ProgressState state() const;

  ProgressStyle style_;
  ProgressState start_;
  std::FILE* stream_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::atomic<std::uint64_t> samples_{0};
  mutable std::mutex error_mutex_;
  double error_ = std::numeric_limits<double>::infinity();
  std::uint64_t samples_at_error_ = 0;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace brume
