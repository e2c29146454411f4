// SPDX-License-Identifier: Apache-2.0
#include "study/report_text.h"

#include <fmt/format.h>

#include <cmath>

namespace brume {
namespace {

/// Two significant digits, never in powers of ten.
std::string two_digits(double x) {
  if (x == 0.0 || !std::isfinite(x)) return fmt::format("{}", x);
  const int before_point = int(std::floor(std::log10(std::abs(x)))) + 1;
  return fmt::format("{:.{}f}", x, std::max(2 - before_point, 0));
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
  return percent_text(root.value) + " ± " + percent_text(0.5 * (root.high - root.low));
}

std::string signed_text(const Estimate& estimate) {
  const char* sign = estimate.value < 0.0 ? "−" : "+";
  return sign + percent_text(std::abs(estimate.value)) + " ± " + percent_text(estimate.error);
}

std::string memory_text(std::size_t bytes) {
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
