// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light.h"

namespace brume {

/// Light from infinitely far away that a ray sees when it leaves the scene. It looks the same from
/// everywhere.
class EnvironmentLight : public Light {
 public:
  struct View {
    Rgb L;      // [W/(m^2 sr)]
    float pdf;  // density of `sample` [1/sr]; positive wherever L is not black
  };
  /// Along the unit direction `d`, away from the viewer.
  virtual View view(const Vec3& d) const = 0;

  Rgb radiance(const Vec3& d) const { return view(d).L; }
  float pdf(const Vec3& d) const { return view(d).pdf; }
};

}  // namespace brume
