// SPDX-License-Identifier: Apache-2.0
#include "material/plastic_bsdf.h"

#include <cassert>
#include <utility>

#include "core/warp.h"
#include "material/fresnel.h"

namespace brume {

PlasticBsdf::PlasticBsdf(float eta, std::shared_ptr<const Texture> diffuse_reflectance,
                         std::shared_ptr<const Texture> specular_reflectance, bool nonlinear)
    : eta_(eta),
      diffuse_fresnel_(diffuse_fresnel_reflectance(eta)),
      base_(eta, std::move(diffuse_reflectance), nonlinear,
            diffuse_fresnel_reflectance(1.0f / eta)),
      specular_reflectance_(std::move(specular_reflectance)) {
  assert(eta > 0.0f);
}

float PlasticBsdf::p_specular(float R_o, const Vec2& uv) const {
  const float specular = R_o * mean(specular_reflectance_->value(uv));
  const float diffuse = (1.0f - R_o) * mean(base_.reflectance(uv));
  return specular > 0.0f ? specular / (specular + diffuse) : 0.0f;
}

Rgb PlasticBsdf::eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return Rgb{0.0f};
  const float T_o = 1.0f - fresnel_dielectric(wo.z, eta_).R;
  const float T_i = 1.0f - fresnel_dielectric(wi.z, eta_).R;
  return base_.response(uv) * (T_o * T_i * wi.z / kPi);
}

float PlasticBsdf::pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return 0.0f;
  return (1.0f - p_specular(fresnel_dielectric(wo.z, eta_).R, uv)) * wi.z / kPi;
}

std::optional<BsdfSample> PlasticBsdf::sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                              const Vec2& u) const {
  if (!(wo.z > 0.0f)) return std::nullopt;
  const float R_o = fresnel_dielectric(wo.z, eta_).R;
  const float p = p_specular(R_o, uv);
  if (u_lobe < p) {
    return BsdfSample{.wi = reflect(wo),
                      .weight = specular_reflectance_->value(uv) * (R_o / p),
                      .pdf = kInfinity};
  }
  const Vec3 wi = sample_cosine_hemisphere(u);
  const float density = (1.0f - p) * wi.z / kPi;
  if (!(density > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = wi, .weight = eval(wo, wi, uv) / density, .pdf = density};
}

Rgb PlasticBsdf::albedo(const Vec2& uv) const {
  // The mean transmittance is the same from both sides but for eta^2.
  const float T = 1.0f - diffuse_fresnel_;
  return diffuse_fresnel_ * specular_reflectance_->value(uv) + T * T * base_.response(uv);
}

}  // namespace brume
