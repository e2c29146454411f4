// SPDX-License-Identifier: Apache-2.0
#include "study/report_text.h"

#include <fmt/format.h>

#include <cmath>

namespace brume {
namespace {

/// Places behind the point that show `digits` significant ones of x > 0.
int places_of(double x, int digits) {
  const int before_point = int(std::floor(std::log10(x))) + 1;
  return std::max(digits - before_point, 0);
}

/// Two significant digits, never in powers of ten.
std::string two_digits(double x) {
  if (x == 0.0 || !std::isfinite(x)) return fmt::format("{}", x);
  return fmt::format("{:.{}f}", x, places_of(std::abs(x), 2));
}

/// Both in percent, to the places that the error leaves.
std::string with_error(double value, double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return percent_text(value);
  const int places = places_of(100.0 * error, 1);
  return fmt::format("{:.{}f}% ± {:.{}f}%", 100.0 * value, places, 100.0 * error, places);
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 99.5) return two_digits(seconds) + " s";
  if (seconds < 99.5 * 60.0) return two_digits(seconds / 60.0) + " min";
  if (seconds < 99.5 * 3600.0) return two_digits(seconds / 3600.0) + " h";
  return two_digits(seconds / 86400.0) + " days";
}

std::string percent_text(double x) {
  return two_digits(100.0 * x) + "%";
}

std::string root_text(const RootInterval& root) {
  if (root.low == 0.0) return "below " + percent_text(root.high);
  return with_error(root.value, 0.5 * (root.high - root.low));
}

std::string signed_text(const Estimate& estimate) {
  const char* sign = estimate.value < 0.0 ? "−" : "+";
  return sign + with_error(std::abs(estimate.value), estimate.error);
}

std::string memory_text(std::size_t bytes) {
  if (bytes == 0) return "none";
  if (bytes < 1'000'000) return two_digits(1e-3 * double(bytes)) + " kB";
  return two_digits(1e-6 * double(bytes)) + " MB";
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace brume
