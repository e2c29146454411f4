// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace brume {

/// Pixels a multiple of this apart along both axes may share light paths; any others are
/// independent. [pixel]
inline constexpr int kLightPathSpacing = 9;

/// How light is looked for. All choices have the same expectation.
struct LightingSettings {
  bool near_lights = true;      // points of a flight near a light, beside those where it scatters
  bool light_paths = true;      // places that light from lamps reaches, connected to camera's paths
  bool shadow_roulette = true;  // fewer shadow rays into directions that little is scattered to
};

/// What a picture may leave out for speed. Every other value than the default is biased.
struct Approximations {
  float clamp = std::numeric_limits<float>::infinity();  // largest contribution of light that has
                                                         // scattered more than once [W/(m^2 sr)]
  int similarity = std::numeric_limits<int>::max();      // scatterings after which media are taken
                                                         // for isotropic ones that are similar
};

/// What limits the paths of a picture; Mitsuba's parameters of the same names.
struct PathSettings {
  int max_depth = -1;          // 1: emitted light only, 2: one scattering, -1: unlimited
  int rr_depth = 5;            // scatterings before Russian roulette begins
  bool hide_emitters = false;  // lights are not seen directly; they still light the scene
  LightingSettings lighting{};
  Approximations approximations{};
};

}  // namespace brume
