// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace brume {

/// A dense volume in Mitsuba's .vol format, version 3.
struct VolFile {
  glm::ivec3 resolution{0};
  int channels = 1;                       // 1 or 3
  glm::dvec3 box_min{0.0}, box_max{1.0};  // as in the header
  std::string value_type;                 // in the file, in words: "float", "half float", "uint8"
  std::vector<float> values;  // [z][y][x][channel], x fastest; empty when only the header was read
};

/// Throws an Error when the header makes no sense or the file is shorter than it says.
VolFile read_vol_header(const std::string& path);
VolFile read_vol_file(const std::string& path);

}  // namespace brume
