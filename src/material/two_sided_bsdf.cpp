// SPDX-License-Identifier: Apache-2.0
#include "material/two_sided_bsdf.h"

#include <algorithm>
#include <utility>

namespace brume {

namespace {

/// The back side is its own front side seen in the mirror of the surface.
Vec3 mirrored(const Vec3& w) {
  return {w.x, w.y, -w.z};
}

}  // namespace

TwoSidedBsdf::TwoSidedBsdf(std::shared_ptr<const Bsdf> front, std::shared_ptr<const Bsdf> back)
    : front_(std::move(front)), back_(std::move(back)) {}

Rgb TwoSidedBsdf::eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  return wo.z > 0.0f ? front_->eval(wo, wi, uv) : back_->eval(mirrored(wo), mirrored(wi), uv);
}

float TwoSidedBsdf::pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const {
  return wo.z > 0.0f ? front_->pdf(wo, wi, uv) : back_->pdf(mirrored(wo), mirrored(wi), uv);
}

std::optional<BsdfSample> TwoSidedBsdf::sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                               const Vec2& u) const {
  if (wo.z > 0.0f) return front_->sample(wo, uv, u_lobe, u);
  std::optional<BsdfSample> s = back_->sample(mirrored(wo), uv, u_lobe, u);
  if (s) s->wi = mirrored(s->wi);
  return s;
}

bool TwoSidedBsdf::has_smooth_lobe() const {
  return front_->has_smooth_lobe() || back_->has_smooth_lobe();
}

std::optional<float> TwoSidedBsdf::mirror_lobe() const {
  const auto front = front_->mirror_lobe(), back = back_->mirror_lobe();
  if (!front || !back) return std::nullopt;
  return std::min(*front, *back);
}

Rgb TwoSidedBsdf::albedo(const Vec2& uv) const {
  return 0.5f * (front_->albedo(uv) + back_->albedo(uv));
}

}  // namespace brume
