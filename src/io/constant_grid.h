// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/volume_file.h"

namespace brume {

/// The value everywhere in the cube [0, 1]^3 under `to_world`, and 0 outside.
AnyGrid make_constant_grid(const Rgb& value, const glm::dmat4& to_world);

}  // namespace brume
