// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/vec.h"

namespace brume {

struct Ray {
  Vec3 o;  // origin [unit]
  Vec3 d;  // unit direction

  Vec3 at(float t) const { return o + t * d; }
};

}  // namespace brume
