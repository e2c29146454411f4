// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "light/distant_disk_light.h"
#include "light/environment_map.h"

namespace brume {

/// Mean angular radius of the sun seen from the earth [rad], 0.2665 degrees.
inline constexpr float kSunAngularRadius = 0.2665f * kPi / 180.0f;

/// The light of a clear day; both parts belong in a LightSet.
struct Daylight {
  std::shared_ptr<const EnvironmentMap> sky;  // and the ground below it, without the sun's disk
  std::shared_ptr<const DistantDiskLight> sun;
};

/// Sun and sky with +Y up, and grey ground below the horizon. The ratio of sun to sky is physical;
/// the scale is that of a camera set for the scene: a white diffuse surface facing the sun has
/// luminance 1.
///
/// `to_sun` is unit with y >= 0. `turbidity` in [2, 10] is the haziness of the air: 2 very clear,
/// 3 clear, 6 hazy.
Daylight make_daylight(const Vec3& to_sun, float turbidity);

}  // namespace brume
