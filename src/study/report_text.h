// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "study/accuracy.h"

namespace brume {

/// "14 s", "21 min", "3.2 h": two digits, in the unit that people would choose.
std::string duration_text(double seconds);

/// "0.35%" of 0.0035: two digits.
std::string percent_text(double x);

/// "0.35% +- 0.02%"; "below 0.4%" where the interval reaches down to 0.
std::string root_text(const RootInterval& root);

/// "-1.2% +- 0.3%".
std::string signed_text(const Estimate& estimate);

/// "12 MB".
std::string memory_text(std::size_t bytes);

/// `text` with the characters that HTML and SVG keep for themselves written out.
std::string escaped(std::string_view text);

}  // namespace brume
