// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "material/bsdf.h"

namespace brume {

/// A reflecting material on either side of the surface. Mitsuba's `twosided`.
class TwoSidedBsdf final : public Bsdf {
 public:
  /// Both must reflect only; they may be the same.
  TwoSidedBsdf(std::shared_ptr<const Bsdf> front, std::shared_ptr<const Bsdf> back);

  Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                   const Vec2& u) const override;
  bool has_smooth_lobe() const override;
  bool is_diffuse() const override { return front_->is_diffuse() && back_->is_diffuse(); }
  std::optional<float> mirror_lobe() const override;
  /// Mean of the two sides.
  Rgb albedo(const Vec2& uv) const override;

 private:
  std::shared_ptr<const Bsdf> front_, back_;
};

}  // namespace brume
