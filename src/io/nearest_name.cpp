// SPDX-License-Identifier: Apache-2.0
#include "io/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace brume {
namespace {

constexpr std::size_t kMaxLength = 64;  // longer words are not typing errors

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

// Damerau 1964, restricted to neighbouring swaps that are not edited again.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> d((a.size() + 1) * width);
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i * width + j] = i + j;
        continue;
      }
      const std::size_t replaced =
          d[(i - 1) * width + j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      std::size_t best = std::min({d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1, replaced});
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1])) {
        best = std::min(best, d[(i - 2) * width + j - 2] + 1);
      }
      d[i * width + j] = best;
    }
  }
  return d.back();
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& valid) {
  if (name.empty() || name.size() > kMaxLength) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : valid) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& valid) {
  if (const std::string nearest = nearest_name(name, valid); !nearest.empty()) {
    return fmt::format("; did you mean \"{}\"?", nearest);
  }
  if (valid.empty()) return "; none is expected here";
  return fmt::format("; expected one of {}", fmt::join(valid, ", "));
}

}  // namespace brume
