// SPDX-License-Identifier: Apache-2.0
#include "material/rough_dielectric_bsdf.h"

#include <cassert>
#include <utility>

#include "material/fresnel.h"

namespace brume {

RoughDielectricBsdf::RoughDielectricBsdf(const Microfacets& microfacets, float eta,
                                         std::shared_ptr<const Texture> specular_reflectance,
                                         std::shared_ptr<const Texture> specular_transmittance)
    : microfacets_(microfacets),
      eta_(eta),
      reflectance_(std::move(specular_reflectance)),
      transmittance_(std::move(specular_transmittance)) {
  assert(eta > 0.0f && eta != 1.0f);
}

RoughDielectricBsdf::Facet RoughDielectricBsdf::facet_between(const Vec3& wo,
                                                              const Vec3& wi) const {
  if (wo.z == 0.0f || wi.z == 0.0f) return {};
  const bool reflected = wo.z * wi.z > 0.0f;
  const float eta = reflected ? 1.0f : (wo.z > 0.0f ? eta_ : 1.0f / eta_);
  const Vec3 h = wo + eta * wi;  // Walter et al. 2007, eq. 13 and 16
  const Vec3 m = glm::normalize(h.z > 0.0f ? h : -h);
  const float o_m = glm::dot(wo, m), i_m = glm::dot(wi, m);
  const float R = fresnel_dielectric(o_m, eta_).R;
  const float pdf_m = microfacets_.pdf_visible(wo, m);
  if (reflected) return {.m = m, .pdf = pdf_m * R / (4.0f * std::abs(o_m)), .eta = eta};
  if (o_m * i_m >= 0.0f) return {};
  const float d = o_m + eta * i_m;
  const float jacobian = eta * eta * std::abs(i_m) / (d * d);  // eq. 17
  return {.m = m, .pdf = pdf_m * (1.0f - R) * jacobian, .eta = eta};
}

Rgb RoughDielectricBsdf::weight(const Vec3& wi, const Facet& facet, const Vec2& uv) const {
  const float G1 = microfacets_.G1(wi, facet.m);
  if (facet.eta == 1.0f) return G1 * reflectance_->value(uv);
  // Radiance over the squared index is what a boundary keeps (Veach 1997, section 5.2).
  return G1 / (facet.eta * facet.eta) * transmittance_->value(uv);
}

Rgb RoughDielectricBsdf::eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  const Facet facet = facet_between(wo, wi);
  if (!(facet.pdf > 0.0f)) return Rgb{0.0f};
  return facet.pdf * weight(wi, facet, uv);
}

float RoughDielectricBsdf::pdf(const Vec3& wo, const Vec3& wi, const Vec2& /*uv*/) const {
  return facet_between(wo, wi).pdf;
}

std::optional<BsdfSample> RoughDielectricBsdf::sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                                      const Vec2& u) const {
  if (wo.z == 0.0f) return std::nullopt;
  const Vec3 m = microfacets_.sample_visible(wo.z > 0.0f ? wo : -wo, u);
  const DielectricFresnel fresnel = fresnel_dielectric(glm::dot(wo, m), eta_);
  const bool reflects = u_lobe < fresnel.R;
  const Vec3 wi = glm::normalize(reflects ? reflect(wo, m) : refract(wo, m, fresnel));
  // A facet may reflect into the surface or refract out of it; that light is lost.
  if (!(reflects ? wo.z * wi.z > 0.0f : wo.z * wi.z < 0.0f)) return std::nullopt;
  const Facet facet = facet_between(wo, wi);
  if (!(facet.pdf > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = wi, .weight = weight(wi, facet, uv), .pdf = facet.pdf, .eta = facet.eta};
}

Rgb RoughDielectricBsdf::albedo(const Vec2& uv) const {
  const float R = fresnel_dielectric(1.0f, eta_).R;
  return R * reflectance_->value(uv) + (1.0f - R) * transmittance_->value(uv);
}

}  // namespace brume
