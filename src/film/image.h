// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

/// A picture of named float channels, as in an EXR file: "R", "G", "B", "A", "depth.Z".
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels{};
  std::vector<float> pixels{};  // [height][width][channels], top row first

  /// Position of the channel called `name`; nothing when there is none.
  std::optional<std::size_t> channel(std::string_view name) const {
    const auto found = std::find(channels.begin(), channels.end(), name);
    if (found == channels.end()) return std::nullopt;
    return std::size_t(found - channels.begin());
  }

  float& at(int x, int y, std::size_t channel) { return pixels[index(x, y, channel)]; }
  float at(int x, int y, std::size_t channel) const { return pixels[index(x, y, channel)]; }

 private:
  std::size_t index(int x, int y, std::size_t channel) const {
    return (std::size_t(y) * std::size_t(width) + std::size_t(x)) * channels.size() + channel;
  }
};

}  // namespace brume
