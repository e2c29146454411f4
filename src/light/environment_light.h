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
  /// How much there is to gain from looking for this light rather than waiting for paths to leave
  /// the scene: the fluence of the radiance above its mean, which is 0 where all directions are
  /// alike (MIS compensation, Karlík et al. 2019).
  float importance(const Vec3& p) const override = 0;

  /// Along the unit direction `d`, away from the viewer.
  virtual View view(const Vec3& d) const = 0;

  Rgb radiance(const Vec3& d) const { return view(d).L; }
  float pdf(const Vec3& d) const { return view(d).pdf; }
};

}  // namespace brume
