// SPDX-License-Identifier: Apache-2.0
#include "material/dielectric_bsdf.h"

#include <cassert>
#include <utility>

#include "material/fresnel.h"

namespace brume {

DielectricBsdf::DielectricBsdf(float eta, std::shared_ptr<const Texture> specular_reflectance,
                               std::shared_ptr<const Texture> specular_transmittance)
    : eta_(eta),
      reflectance_(std::move(specular_reflectance)),
      transmittance_(std::move(specular_transmittance)) {
  assert(eta > 0.0f);
}

std::optional<BsdfSample> DielectricBsdf::sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                                 const Vec2& /*u*/) const {
  const DielectricFresnel fresnel = fresnel_dielectric(wo.z, eta_);
  if (u_lobe < fresnel.R) {
    return BsdfSample{.wi = reflect(wo), .weight = reflectance_->value(uv), .pdf = kInfinity};
  }
  // Radiance over the squared index is what a boundary keeps (Veach 1997, section 5.2).
  return BsdfSample{.wi = refract(wo, fresnel),
                    .weight = transmittance_->value(uv) / (fresnel.eta * fresnel.eta),
                    .pdf = kInfinity,
                    .eta = fresnel.eta};
}

Rgb DielectricBsdf::albedo(const Vec2& uv) const {
  const float R = fresnel_dielectric(1.0f, eta_).R;
  return R * reflectance_->value(uv) + (1.0f - R) * transmittance_->value(uv);
}

}  // namespace brume
