// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace brume {

/// The words between spaces, tabs, line ends and commas.
std::vector<std::string_view> split_words(std::string_view text);

/// The number that `text` spells, whole and finite, in any locale written with a point; surrounding
/// blanks are allowed. Nothing when it is anything else.
std::optional<double> parse_number(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace brume
