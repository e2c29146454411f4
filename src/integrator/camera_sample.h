// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"

namespace brume {

/// What limits the paths of a picture; Mitsuba's parameters of the same names.
struct PathSettings {
  int max_depth = -1;          // 1: emitted light only, 2: one scattering, -1: unlimited
  int rr_depth = 5;            // scatterings before Russian roulette begins
  bool hide_emitters = false;  // lights are not seen directly; they still light the scene
};

/// One sample of what a pixel shows.
struct CameraSample {
  Rgb L{0.0f};         // radiance [W/(m^2 sr)]
  float alpha = 0.0f;  // opacity along the camera ray
  Rgb albedo{0.0f};    // of the first surface or scattering event; black if there is none
  float depth = 0.0f;  // distance to it [unit]; 0 if there is none
};

}  // namespace brume
