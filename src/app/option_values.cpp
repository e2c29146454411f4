// SPDX-License-Identifier: Apache-2.0
#include "app/option_values.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace brume {
namespace {

/// The number that `text` begins with, and what follows it; nothing when it begins with none.
std::optional<std::pair<double, std::string>> leading_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return std::pair{value, std::string(end, text.data() + text.size())};
}

}  // namespace

std::function<std::string(const std::string&)> number_between(double lo, double hi) {
  return [=](const std::string& text) -> std::string {
    const auto number = leading_number(text);
    if (number && number->second.empty() && number->first >= lo && number->first <= hi) return {};
    return fmt::format("\"{}\" is no number from {:.3g} to {:.3g}", text, lo, hi);
  };
}

double parse_duration(const char* option, const std::string& text) {
  if (const auto number = leading_number(text); number && number->first > 0.0) {
    const auto& [value, unit] = *number;
    if (unit.empty() || unit == "s") return value;
    if (unit == "m" || unit == "min") return 60.0 * value;
    if (unit == "h") return 3600.0 * value;
  }
  throw CLI::ValidationError(option,
                             fmt::format("\"{}\" is no duration; write 90s, 5m or 1.5h", text));
}

double parse_error(const char* option, const std::string& text) {
  if (const auto number = leading_number(text)) {
    const auto& [value, unit] = *number;
    const double error = unit == "%" ? value / 100.0 : value;
    if ((unit.empty() || unit == "%") && error > 0.0 && error < 1.0) return error;
  }
  throw CLI::ValidationError(
      option, fmt::format("\"{}\" is no relative error below 1; write 1% or 0.01", text));
}

glm::ivec2 parse_size(const char* option, const std::string& text) {
  constexpr int kMaxSize = 65536;
  glm::ivec2 size(0);
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.x);
  if (width.ec == std::errc{} && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X')) {
    const auto height = std::from_chars(width.ptr + 1, end, size.y);
    if (height.ec == std::errc{} && height.ptr == end && size.x > 0 && size.y > 0 &&
        size.x <= kMaxSize && size.y <= kMaxSize)
      return size;
  }
  throw CLI::ValidationError(option, fmt::format("\"{}\" is no picture size; write width x height "
                                                 "in pixels, such as 1280x720, each at most {}",
                                                 text, kMaxSize));
}

Rgb parse_albedo(const char* option, const std::string& text) {
  std::vector<float> values;
  std::string rest = text;
  while (const auto number = leading_number(rest)) {
    values.push_back(static_cast<float>(number->first));
    rest = number->second;
    if (rest.size() < 2 || rest[0] != ',') break;
    rest.erase(0, 1);
  }
  const bool in_range =
      std::all_of(values.begin(), values.end(), [](float v) { return v >= 0.0f && v <= 1.0f; });
  if (rest.empty() && in_range && values.size() == 1) return Rgb(values[0]);
  if (rest.empty() && in_range && values.size() == 3) return {values[0], values[1], values[2]};
  throw CLI::ValidationError(
      option, fmt::format("\"{}\" is no albedo; write one number in [0, 1] or three, such as "
                          "0.9,0.95,1",
                          text));
}

std::pair<std::string, std::string> parse_definition(const char* option, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw CLI::ValidationError(option,
                               fmt::format("\"{}\" defines nothing; write name=value", text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace brume
