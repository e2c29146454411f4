// SPDX-License-Identifier: Apache-2.0
#include "material/thin_dielectric_bsdf.h"

#include <cassert>
#include <utility>

#include "material/fresnel.h"

namespace brume {

ThinDielectricBsdf::ThinDielectricBsdf(float eta,
                                       std::shared_ptr<const Texture> specular_reflectance,
                                       std::shared_ptr<const Texture> specular_transmittance)
    : eta_(eta),
      reflectance_(std::move(specular_reflectance)),
      transmittance_(std::move(specular_transmittance)) {
  assert(eta > 0.0f);
}

float ThinDielectricBsdf::pane_reflectance(float cos_theta) const {
  // R + T R T + T R^3 T + ... with T = 1 - R, both faces alike; a geometric series.
  const float R = fresnel_dielectric(std::abs(cos_theta), eta_).R;
  return 2.0f * R / (1.0f + R);
}

std::optional<BsdfSample> ThinDielectricBsdf::sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                                     const Vec2& /*u*/) const {
  if (u_lobe < pane_reflectance(wo.z)) {
    return BsdfSample{.wi = reflect(wo), .weight = reflectance_->value(uv), .pdf = kInfinity};
  }
  return BsdfSample{
      .wi = -wo, .weight = transmittance_->value(uv), .pdf = kInfinity, .straight = true};
}

Rgb ThinDielectricBsdf::straight_transmittance(const Vec3& wo, const Vec2& uv) const {
  return (1.0f - pane_reflectance(wo.z)) * transmittance_->value(uv);
}

Rgb ThinDielectricBsdf::albedo(const Vec2& uv) const {
  const float R = pane_reflectance(1.0f);
  return R * reflectance_->value(uv) + (1.0f - R) * transmittance_->value(uv);
}

}  // namespace brume
