// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"

namespace brume {

/// What one camera sample saw.
struct CameraSample {
  Rgb L{0.0f};              // radiance [W/(m^2 sr)]
  float alpha = 0.0f;       // estimate of the opacity along the camera ray
  Rgb albedo{0.0f};         // of the first event or surface; black when there was none
  float depth = kInfinity;  // distance to it along the camera ray [unit]; infinite when none
  float work = 1.0f;        // flights of the path: its cost, in a unit that no machine changes
};

}  // namespace brume
