// SPDX-License-Identifier: Apache-2.0
#include "material/diffuse_bsdf.h"

#include <utility>

#include "core/warp.h"

namespace brume {

DiffuseBsdf::DiffuseBsdf(std::shared_ptr<const Texture> reflectance)
    : reflectance_(std::move(reflectance)) {}

Rgb DiffuseBsdf::eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  if (!(wo.z > 0.0f && wi.z > 0.0f)) return Rgb{0.0f};
  return reflectance_->value(uv) * (wi.z / kPi);
}

float DiffuseBsdf::pdf(const Vec3& wo, const Vec3& wi, const Vec2& /*uv*/) const {
  return wo.z > 0.0f && wi.z > 0.0f ? wi.z / kPi : 0.0f;
}

std::optional<BsdfSample> DiffuseBsdf::sample(const Vec3& wo, const Vec2& uv, float /*u_lobe*/,
                                              const Vec2& u) const {
  if (!(wo.z > 0.0f)) return std::nullopt;
  const Vec3 wi = sample_cosine_hemisphere(u);
  if (!(wi.z > 0.0f)) return std::nullopt;
  return BsdfSample{.wi = wi, .weight = reflectance_->value(uv), .pdf = wi.z / kPi};
}

Rgb DiffuseBsdf::albedo(const Vec2& uv) const {
  return reflectance_->value(uv);
}

}  // namespace brume
