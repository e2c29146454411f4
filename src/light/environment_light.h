// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light.h"

namespace brume {

/// Light from infinitely far away that a ray sees when it leaves the scene. It looks the same from
/// everywhere.
class EnvironmentLight : public Light {
 public:
  /// Seen along the unit direction `d`, away from the viewer [W/(m^2 sr)].
  virtual Rgb radiance(const Vec3& d) const = 0;
  /// Density of `sample` for `d` [1/sr]; positive wherever `radiance` is not black.
  virtual float pdf(const Vec3& d) const = 0;
};

}  // namespace brume
