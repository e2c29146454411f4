// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace brume {

/// What the header of a dense volume in Mitsuba's .vol format, version 3, says.
struct VolHeader {
  glm::ivec3 resolution{0};
  int channels = 1;                       // 1 or 3
  glm::dvec3 box_min{0.0}, box_max{1.0};  // as in the file
  std::string value_type{};               // in words: "float", "half float", "uint8"
  std::uint64_t bytes = 0;                // of the file, as far as the header speaks of it
};

/// Gives the values of the next `count` layers of equal z: [z][y][x][channel], x fastest.
using NextLayers = std::function<std::vector<float>(int count)>;

/// A .vol file, read by layers so that it never lies in memory whole.
class VolReader {
 public:
  /// Throws an Error when the header makes no sense or the file is shorter than it says.
  explicit VolReader(std::string path);

  const VolHeader& header() const { return header_; }
  std::uint64_t file_bytes() const { return file_bytes_; }

  /// As `NextLayers`. Throws an Error when the file cannot be read.
  std::vector<float> read_layers(int count);

 private:
  std::string path_;
  std::ifstream stream_;
  std::uint64_t file_bytes_;
  VolHeader header_;
  int bytes_of_value_ = 0;
};

}  // namespace brume
