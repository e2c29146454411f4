// SPDX-License-Identifier: Apache-2.0
#include "material/rough_conductor_bsdf.h"

#include <utility>

#include "material/fresnel.h"

namespace brume {

RoughConductorBsdf::RoughConductorBsdf(const Microfacets& microfacets, const Rgb& eta, const Rgb& k,
                                       std::shared_ptr<const Texture> specular_reflectance)
    : microfacets_(microfacets), eta_(eta), k_(k), reflectance_(std::move(specular_reflectance)) {}

Rgb RoughConductorBsdf::eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return Rgb{0.0f};
  const Vec3 m = glm::normalize(wo + wi);
  const float G1_wi = microfacets_.G1(wi, m);
  return pdf(wo, wi, uv) * G1_wi * reflectance_->value(uv) *
         fresnel_conductor(glm::dot(wo, m), eta_, k_);
}

float RoughConductorBsdf::pdf(const Vec3& wo, const Vec3& wi, const Vec2& /*uv*/) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return 0.0f;
  return microfacets_.pdf_reflection(wo, wi);
}

std::optional<BsdfSample> RoughConductorBsdf::sample(const Vec3& wo, const Vec2& uv,
                                                     float /*u_lobe*/, const Vec2& u) const {
  if (!(wo.z > 0.0f)) return std::nullopt;
  const Vec3 m = microfacets_.sample_visible(wo, u);
  const Vec3 wi = reflect(wo, m);
  const float density = pdf(wo, wi, uv);
  if (!(density > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = wi,
                    .weight = microfacets_.G1(wi, m) * reflectance_->value(uv) *
                              fresnel_conductor(glm::dot(wo, m), eta_, k_),
                    .pdf = density};
}

Rgb RoughConductorBsdf::albedo(const Vec2& uv) const {
  return reflectance_->value(uv) * fresnel_conductor(1.0f, eta_, k_);
}

}  // namespace brume
