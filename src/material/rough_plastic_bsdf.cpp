// SPDX-License-Identifier: Apache-2.0
#include "material/rough_plastic_bsdf.h"

#include <cassert>
#include <utility>

#include "core/warp.h"
#include "material/fresnel.h"

namespace brume {

namespace {

/// Fraction of light from a direction at `cos_theta` that a rough boundary reflects. `eta` is the
/// index behind the boundary over that before it.
double rough_reflectance(const Microfacets& microfacets, float eta, float cos_theta) {
  // Midpoint rule over the numbers that choose a facet; the angle at grazing incidence is the
  // limit, not the singular point.
  constexpr int kSteps = 32;
  const float z = std::max(cos_theta, 1e-4f);
  const Vec3 wo(std::sqrt((1.0f - z) * (1.0f + z)), 0.0f, z);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Vec2 u = (Vec2(i, j) + 0.5f) / float(kSteps);
      const Vec3 m = microfacets.sample_visible(wo, u);
      const Vec3 wi = reflect(wo, m);
      if (!(wi.z > 0.0f)) continue;
      sum += double(fresnel_dielectric(glm::dot(wo, m), eta).R * microfacets.G1(wi, m));
    }
  }
  return sum / (kSteps * kSteps);
}

constexpr std::size_t kTableSize = 64;

float table_cosine(std::size_t i) {
  return float(i) / float(kTableSize - 1);
}

/// Its mean under diffuse light, by the sum that Mitsuba 3 takes: both ends count whole, so that
/// it is 1.5% below the integral. The diffuse colour of its scenes depends on it.
double rough_diffuse_reflectance(const Microfacets& microfacets, float eta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kTableSize; ++i) {
    sum += 2.0 * double(table_cosine(i)) * rough_reflectance(microfacets, eta, table_cosine(i));
  }
  return sum / kTableSize;
}

}  // namespace

RoughPlasticBsdf::RoughPlasticBsdf(const Microfacets& microfacets, float eta,
                                   std::shared_ptr<const Texture> diffuse_reflectance,
                                   std::shared_ptr<const Texture> specular_reflectance,
                                   bool nonlinear)
    : microfacets_(microfacets),
      eta_(eta),
      base_(eta, std::move(diffuse_reflectance), nonlinear,
            float(rough_diffuse_reflectance(microfacets, 1.0f / eta))),
      specular_reflectance_(std::move(specular_reflectance)) {
  assert(eta > 0.0f);
  for (std::size_t i = 0; i < kTableSize; ++i) {
    transmittance_[i] = float(1.0 - rough_reflectance(microfacets, eta, table_cosine(i)));
  }
}

float RoughPlasticBsdf::coat_transmittance(float cos_theta) const {
  const float x = std::clamp(cos_theta, 0.0f, 1.0f) * float(kTableSize - 1);
  const std::size_t i = std::min(std::size_t(x), kTableSize - 2);
  return glm::mix(transmittance_[i], transmittance_[i + 1], x - float(i));
}

float RoughPlasticBsdf::p_specular(float T_o, const Vec2& uv) const {
  const float specular = (1.0f - T_o) * mean(specular_reflectance_->value(uv));
  const float diffuse = T_o * mean(base_.reflectance(uv));
  return specular > 0.0f ? specular / (specular + diffuse) : 0.0f;
}

Rgb RoughPlasticBsdf::eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return Rgb{0.0f};
  const Vec3 m = glm::normalize(wo + wi);
  const float specular = fresnel_dielectric(glm::dot(wo, m), eta_).R * microfacets_.G1(wi, m) *
                         microfacets_.pdf_reflection(wo, wi);
  const float T = coat_transmittance(wo.z) * coat_transmittance(wi.z);
  return specular * specular_reflectance_->value(uv) + base_.response(uv) * (T * wi.z / kPi);
}

float RoughPlasticBsdf::pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return 0.0f;
  const float p = p_specular(coat_transmittance(wo.z), uv);
  return p * microfacets_.pdf_reflection(wo, wi) + (1.0f - p) * wi.z / kPi;
}

std::optional<BsdfSample> RoughPlasticBsdf::sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                                   const Vec2& u) const {
  if (!(wo.z > 0.0f)) return std::nullopt;
  const bool specular = u_lobe < p_specular(coat_transmittance(wo.z), uv);
  const Vec3 wi =
      specular ? reflect(wo, microfacets_.sample_visible(wo, u)) : sample_cosine_hemisphere(u);
  const float density = pdf(wo, wi, uv);
  if (!(density > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = wi, .weight = eval(wo, wi, uv) / density, .pdf = density};
}

Rgb RoughPlasticBsdf::albedo(const Vec2& uv) const {
  // Mean over the cosine-weighted hemisphere, by the trapezoidal rule on the table.
  const std::size_t last = kTableSize - 1;
  float T = 0.0f;
  for (std::size_t i = 0; i <= last; ++i) {
    const float weight = (i == last ? 1.0f : 2.0f) * float(i) / float(last * last);
    T += weight * transmittance_[i];
  }
  return (1.0f - T) * specular_reflectance_->value(uv) + T * T * base_.response(uv);
}

}  // namespace brume
