// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/microfacet.h"
#include "material/texture.h"

namespace brume {

/// Ground glass: facets reflect and refract once. Mitsuba's `roughdielectric`. Light that facets
/// throw at each other is lost.
class RoughDielectricBsdf final : public Bsdf {
 public:
  /// As `DielectricBsdf`, but `eta` differs from 1: there would be nothing to see.
  RoughDielectricBsdf(const Microfacets& microfacets, float eta,
                      std::shared_ptr<const Texture> specular_reflectance,
                      std::shared_ptr<const Texture> specular_transmittance);

  Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  /// Of the smooth boundary at normal incidence.
  Rgb albedo(const Vec2& uv) const override;

 private:
  struct Facet {
    Vec3 m;            // unit normal, m.z > 0
    float pdf = 0.0f;  // density of `sample` for the direction it was found for [1/sr]
    float eta = 1.0f;  // index of refraction on the side of wi over that on the side of wo
  };
  /// The one facet that sends light from `wi` to `wo`; pdf 0 where there is none.
  Facet facet_between(const Vec3& wo, const Vec3& wi) const;
  /// f |cos| / pdf for that facet.
  Rgb weight(const Vec3& wi, const Facet& facet, const Vec2& uv) const;

  Microfacets microfacets_;
  float eta_;
  std::shared_ptr<const Texture> reflectance_, transmittance_;
};

}  // namespace brume
