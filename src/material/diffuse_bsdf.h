// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"
#include "material/texture.h"

namespace brume {

/// Lambertian reflection on the outside; black from behind. Mitsuba's `diffuse`.
class DiffuseBsdf final : public Bsdf {
 public:
  /// `reflectance` in [0, 1].
  explicit DiffuseBsdf(std::shared_ptr<const Texture> reflectance);

  Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  bool is_diffuse() const override { return true; }
  Rgb albedo(const Vec2& uv) const override;

 private:
  std::shared_ptr<const Texture> reflectance_;
};

}  // namespace brume
