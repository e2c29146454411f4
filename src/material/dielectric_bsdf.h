// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/texture.h"

namespace brume {

/// A smooth boundary between two dielectrics: reflects and refracts, both Dirac. Mitsuba's
/// `dielectric`. Radiance crossing the boundary scales with the square of the index.
class DielectricBsdf final : public Bsdf {
 public:
  /// `eta` > 0 is the index of refraction inside over that outside. The two factors are 1 for
  /// physical glass.
  DielectricBsdf(float eta, std::shared_ptr<const Texture> specular_reflectance,
                 std::shared_ptr<const Texture> specular_transmittance);

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
  float eta_;
  std::shared_ptr<const Texture> reflectance_, transmittance_;
};

}  // namespace brume
