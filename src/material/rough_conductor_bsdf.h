// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/microfacet.h"
#include "material/texture.h"

namespace brume {

/// A metal whose facets reflect once, on the outside; black from behind. Mitsuba's
/// `roughconductor`. Light that facets throw at each other is lost.
class RoughConductorBsdf final : public Bsdf {
 public:
  /// As `ConductorBsdf`.
  RoughConductorBsdf(const Microfacets& microfacets, const Rgb& eta, const Rgb& k,
                     std::shared_ptr<const Texture> specular_reflectance);

  Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  std::optional<float> mirror_lobe() const override { return microfacets_.mirror_lobe(); }
  /// Of the smooth metal at normal incidence.
  Rgb albedo(const Vec2& uv) const override;

 private:
  Microfacets microfacets_;
  Rgb eta_, k_;
  std::shared_ptr<const Texture> reflectance_;
};

}  // namespace brume
