// SPDX-License-Identifier: Apache-2.0
#include "render/progress_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace brume {
namespace {

double samples_per_pixel(const ProgressState& state) {
  return double(state.samples_before + state.samples) / double(state.pixels);
}

/// Samples a pixel that the render will have when it ends, if time does not end it; infinite while
/// nothing tells. The squared error falls as the samples grow.
double final_spp(const ProgressState& state) {
  if (!(state.target_error > 0.0) || !std::isfinite(state.error)) return state.target_spp;
  const double spp_at_error =
      double(state.samples_before + state.samples_at_error) / double(state.pixels);
  const double ratio = state.error / state.target_error;
  return std::min(state.target_spp, spp_at_error * ratio * ratio);
}

/// In [0, 1], of the stop rule that is nearest to its end.
double fraction_done(const ProgressState& state) {
  return std::clamp(
      std::max(samples_per_pixel(state) / final_spp(state), state.seconds / state.seconds_limit),
      0.0, 1.0);
}

/// Infinite while nothing tells.
double seconds_left(const ProgressState& state) {
  const double samples_left = (final_spp(state) - samples_per_pixel(state)) * double(state.pixels);
  const double by_samples = state.samples > 0 ? state.seconds * samples_left / double(state.samples)
                                              : ProgressState::kUnknown;
  return std::max(0.0, std::min(by_samples, state.seconds_limit - state.seconds));
}

std::string clock_time(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

/// Three digits with a unit prefix: 1.21M.
std::string short_number(double value) {
  const char* const prefixes[] = {"", "k", "M", "G"};
  std::size_t prefix = 0;
  while (value >= 999.5 && prefix < 3) {
    value /= 1000.0;
    prefix += 1;
  }
  const int decimals = value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f}{}", value, decimals, prefixes[prefix]);
}

std::string samples_field(const ProgressState& state) {
  const double spp = samples_per_pixel(state);
  // Cut, not rounded: the target is not shown before it is reached.
  const double tenths = std::floor(spp * 10.0) / 10.0;
  if (std::isinf(state.target_spp)) return fmt::format("{:.1f} spp", tenths);
  if (spp >= state.target_spp) return fmt::format("{0}/{0} spp", state.target_spp);
  return fmt::format("{:.1f}/{} spp", tenths, state.target_spp);
}

std::string error_field(const ProgressState& state) {
  const std::string error = fmt::format("error <{:.2g}%", 100.0 * state.error);
  if (!(state.target_error > 0.0)) return error;
  return fmt::format("{} to {:.4g}%", error, 100.0 * state.target_error);
}

/// Most important first.
std::vector<std::string> fields(const ProgressState& state) {
  std::vector<std::string> result{fmt::format("{:3}%", int(100.0 * fraction_done(state))),
                                  samples_field(state)};
  if (const double left = seconds_left(state); std::isfinite(left))
    result.push_back(clock_time(left) + " left");
  if (std::isfinite(state.error)) result.push_back(error_field(state));
  result.push_back(clock_time(state.seconds) + " elapsed");
  if (state.seconds > 0.0)
    result.push_back(short_number(double(state.samples) / state.seconds) + " samples/s");
  return result;
}

std::string bar(double fraction, int width) {
  const int filled = int(fraction * width);
  std::string result(std::size_t(width), ' ');
  std::fill_n(result.begin(), filled, '=');
  if (filled < width) result[std::size_t(filled)] = '>';
  return "[" + result + "]";
}

}  // namespace

std::string bar_line(const ProgressState& state, int columns) {
  constexpr int kNarrowestBar = 10, kWidestBar = 40;
  std::vector<std::string> parts = fields(state);
  const auto length = [&parts] { return int(fmt::format("{}", fmt::join(parts, "  ")).size()); };
  while (parts.size() > 1 && length() > columns) parts.pop_back();
  const int room = columns - length() - 4;  // brackets and a gap
  if (room >= kNarrowestBar)
    parts.insert(parts.begin() + 1, bar(fraction_done(state), std::min(room, kWidestBar)));
  return fmt::format("{}", fmt::join(parts, "  ")).substr(0, std::size_t(std::max(columns, 0)));
}

std::string plain_line(const ProgressState& state) {
  return fmt::format("{}", fmt::join(fields(state), "  "));
}

}  // namespace brume
