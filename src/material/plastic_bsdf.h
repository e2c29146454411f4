// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/plastic_base.h"
#include "material/texture.h"

namespace brume {

/// A diffuse ground under a smooth dielectric coat, on the outside; black from behind. Mitsuba's
/// `plastic`.
class PlasticBsdf final : public Bsdf {
 public:
  /// `eta` > 0 is the index of refraction of the coat over that outside. `nonlinear` as in
  /// `PlasticBase`.
  PlasticBsdf(float eta, std::shared_ptr<const Texture> diffuse_reflectance,
              std::shared_ptr<const Texture> specular_reflectance, bool nonlinear);

  Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  /// Under diffuse light.
  Rgb albedo(const Vec2& uv) const override;

 private:
  float p_specular(float R_o, const Vec2& uv) const;

  float eta_;
  float diffuse_fresnel_;
  PlasticBase base_;
  std::shared_ptr<const Texture> specular_reflectance_;
};

}  // namespace brume
