// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/texture.h"

namespace brume {

/// A smooth metal: a coloured mirror on the outside; black from behind. Mitsuba's `conductor`.
class ConductorBsdf final : public Bsdf {
 public:
  /// `eta` + i `k` is the complex index of refraction relative to the outside; 0 + i is a perfect
  /// mirror. `specular_reflectance` is 1 for physical metal.
  ConductorBsdf(const Rgb& eta, const Rgb& k, std::shared_ptr<const Texture> specular_reflectance);

  Rgb eval(const Vec3& /*wo*/, const Vec3& /*wi*/, const Vec2& /*uv*/) const override {
    return Rgb{0.0f};
  }
  float pdf(const Vec3& /*wo*/, const Vec3& /*wi*/, const Vec2& /*uv*/) const override {
    return 0.0f;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  bool has_smooth_lobe() const override { return false; }
  /// At normal incidence.
  Rgb albedo(const Vec2& uv) const override;

 private:
  Rgb eta_, k_;
  std::shared_ptr<const Texture> reflectance_;
};

}  // namespace brume
