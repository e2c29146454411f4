// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <utility>

#include "core/rgb.h"

namespace brume {

/// A check for options: a number in [lo, hi]; it returns what is wrong. CLI::Range lets NaN pass.
std::function<std::string(const std::string&)> number_between(double lo, double hi);

// What the text of `option` means. Each throws a CLI::ValidationError that says how to write it.

double parse_duration(const char* option, const std::string& text);  // [s], positive
double parse_error(const char* option, const std::string& text);     // relative, in (0, 1)
glm::ivec2 parse_size(const char* option, const std::string& text);  // [pixel], positive
Rgb parse_albedo(const char* option, const std::string& text);       // in [0, 1]
/// A name and its value.
std::pair<std::string, std::string> parse_definition(const char* option, const std::string& text);

}  // namespace brume
