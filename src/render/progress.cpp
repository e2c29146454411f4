// SPDX-License-Identifier: Apache-2.0
#include "render/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace brume {
namespace {

/// Columns of the terminal behind `stream`, less one: a line that fills the last column wraps on
/// some terminals.
int usable_columns(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 79;
  return size.ws_col - 1;
}

}  // namespace

ProgressStyle progress_style_of(std::FILE* stream) {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return can_redraw && ::isatty(::fileno(stream)) ? ProgressStyle::kBar : ProgressStyle::kPlain;
}

Progress::Progress(ProgressStyle style, const ProgressState& start, std::FILE* stream)
    : style_(style), start_(start), stream_(stream) {
  if (style_ != ProgressStyle::kQuiet)
    thread_ = std::jthread([this](std::stop_token stop) { show_until(std::move(stop)); });
}

Progress::~Progress() {
  if (style_ == ProgressStyle::kQuiet) return;
  thread_.request_stop();
  thread_.join();
  show("\n");
}

void Progress::set_error(double error) {
  const std::lock_guard lock(error_mutex_);
  error_ = error;
  samples_at_error_ = samples_.load(std::memory_order_relaxed);
}

void Progress::show_until(std::stop_token stop) {
  const bool redraws = style_ == ProgressStyle::kBar;
  const auto stopped = [&stop] { return stop.stop_requested(); };
  std::unique_lock lock(mutex_);
  double next = redraws ? 0.0 : 10.0;  // [s] since the start
  while (!wake_.wait_until(lock, stop, begin_ + std::chrono::duration<double>(next), stopped)) {
    show(redraws ? "" : "\n");
    // A log of many hours stays short: lines come at intervals that grow with the time so far.
    const double now = seconds();
    next = redraws ? now + 0.1 : std::max(now + 10.0, 1.1 * now);
  }
}

void Progress::show(const char* line_end) {
  const std::string text =
      style_ == ProgressStyle::kBar
          // Overwriting and then clearing what is left of the old line does not flicker.
          ? fmt::format("\r{}\x1b[K{}", bar_line(state(), usable_columns(stream_)), line_end)
          : plain_line(state()) + line_end;
  std::fwrite(text.data(), 1, text.size(), stream_);
  std::fflush(stream_);
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

ProgressState Progress::state() const {
  ProgressState state = start_;
  state.samples = samples_.load(std::memory_order_relaxed);
  state.seconds = seconds();
  const std::lock_guard lock(error_mutex_);
  state.error = error_;
  state.samples_at_error = samples_at_error_;
  return state;
}

}  // namespace brume
