// SPDX-License-Identifier: Apache-2.0
#include "material/conductor_bsdf.h"

#include <utility>

#include "material/fresnel.h"

namespace brume {

ConductorBsdf::ConductorBsdf(const Rgb& eta, const Rgb& k,
                             std::shared_ptr<const Texture> specular_reflectance)
    : eta_(eta), k_(k), reflectance_(std::move(specular_reflectance)) {}

std::optional<BsdfSample> ConductorBsdf::sample(const Vec3& wo, const Vec2& uv, float /*u_lobe*/,
                                                const Vec2& /*u*/) const {
  if (!(wo.z > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = reflect(wo),
                    .weight = reflectance_->value(uv) * fresnel_conductor(wo.z, eta_, k_),
                    .pdf = kInfinity};
}

Rgb ConductorBsdf::albedo(const Vec2& uv) const {
  return reflectance_->value(uv) * fresnel_conductor(1.0f, eta_, k_);
}

}  // namespace brume
