// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "material/bsdf.h"
#include "material/microfacet.h"
#include "material/plastic_base.h"
#include "material/texture.h"

namespace brume {

/// A diffuse ground under a rough dielectric coat, on the outside; black from behind. Mitsuba's
/// `roughplastic`.
class RoughPlasticBsdf final : public Bsdf {
 public:
  /// As `PlasticBsdf`; `microfacets` are isotropic. The construction integrates the reflectance
  /// of the coat, some milliseconds.
  RoughPlasticBsdf(const Microfacets& microfacets, float eta,
                   std::shared_ptr<const Texture> diffuse_reflectance,
                   std::shared_ptr<const Texture> specular_reflectance, bool nonlinear);

  Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  /// Under diffuse light.
  Rgb albedo(const Vec2& uv) const override;

 private:
  /// Fraction of light that enters the coat from outside.
  float coat_transmittance(float cos_theta) const;
  float p_specular(float T_o, const Vec2& uv) const;

  Microfacets microfacets_;
  float eta_;
  std::array<float, 64> transmittance_;  // of the coat from outside, at cosines 0, 1/63, ..., 1
  PlasticBase base_;
  std::shared_ptr<const Texture> specular_reflectance_;
};

}  // namespace brume
