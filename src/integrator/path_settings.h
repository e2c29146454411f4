// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// How light is looked for. All choices have the same expectation.
struct LightingSettings {
  bool near_lights = true;      // points of a flight near a light, beside those where it scatters
  bool shadow_roulette = true;  // fewer shadow rays into directions that little is scattered to
};

/// What limits the paths of a picture; Mitsuba's parameters of the same names.
struct PathSettings {
  int max_depth = -1;          // 1: emitted light only, 2: one scattering, -1: unlimited
  int rr_depth = 5;            // scatterings before Russian roulette begins
  bool hide_emitters = false;  // lights are not seen directly; they still light the scene
  LightingSettings lighting{};
};

}  // namespace brume
