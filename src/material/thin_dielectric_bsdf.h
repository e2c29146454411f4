// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/texture.h"

namespace brume {

/// A pane of glass too thin to shift light sideways: reflects, and passes the rest straight on,
/// all reflections between its two faces summed. Mitsuba's `thindielectric`.
class ThinDielectricBsdf final : public Bsdf {
 public:
  /// `eta` > 0 is the index of refraction of the pane over that around it. The two factors are 1
  /// for physical glass.
  ThinDielectricBsdf(float eta, std::shared_ptr<const Texture> specular_reflectance,
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
  bool passes_straight() const override { return true; }
  Rgb straight_transmittance(const Vec3& wo, const Vec2& uv) const override;
  /// At normal incidence.
  Rgb albedo(const Vec2& uv) const override;

 private:
  /// Fraction reflected by the pane as a whole.
  float pane_reflectance(float cos_theta) const;

  float eta_;
  std::shared_ptr<const Texture> reflectance_, transmittance_;
};

}  // namespace brume
