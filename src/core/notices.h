// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace brume {

/// What a person must be told although it is no error: something was clamped, converted, chosen or
/// left without effect. In order of discovery.
using Notices = std::vector<std::string>;

}  // namespace brume
