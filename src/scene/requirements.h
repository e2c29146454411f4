// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/scene_parts.h"

namespace brume {

/// A part of the renderer that a scene makes use of, or not, and why.
struct Requirement {
  std::string machinery;
  bool required;
  std::string reason;
  std::size_t memory_bytes = 0;  // of volume data and bounds
};

/// What rendering the scene takes: only that is set up and paid for.
std::vector<Requirement> requirements_of(const SceneParts& parts);

}  // namespace brume
