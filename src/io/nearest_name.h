// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace brume {

/// The valid name closest to `name` in edit distance (insert, delete, replace, swap neighbours;
/// case ignored), or empty when none is close enough to be what was meant.
std::string nearest_name(std::string_view name, const std::vector<std::string>& valid);

/// `; did you mean "x"?`, or else `; expected one of a, b, c` (`; none is expected here` for no
/// valid names): the tail of a message about `name`.
std::string suggestion(std::string_view name, const std::vector<std::string>& valid);

}  // namespace brume
