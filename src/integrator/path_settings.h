// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// What limits the paths of a picture; Mitsuba's parameters of the same names.
struct PathSettings {
  int max_depth = -1;          // 1: emitted light only, 2: one scattering, -1: unlimited
  int rr_depth = 5;            // scatterings before Russian roulette begins
  bool hide_emitters = false;  // lights are not seen directly; they still light the scene
};

}  // namespace brume
