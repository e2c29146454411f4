// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "material/bsdf.h"

namespace brume {

/// An index-matched boundary: light passes as if it were not there. Mitsuba's `null`.
class NullBsdf final : public Bsdf {
 public:
  Rgb eval(const Vec3& /*wo*/, const Vec3& /*wi*/, const Vec2& /*uv*/) const override {
    return Rgb{0.0f};
  }
  float pdf(const Vec3& /*wo*/, const Vec3& /*wi*/, const Vec2& /*uv*/) const override {
    return 0.0f;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& /*uv*/, float /*u_lobe*/,
                                   const Vec2& /*u*/) const override {
    return BsdfSample{.wi = -wo, .weight = Rgb{1.0f}, .pdf = kInfinity, .straight = true};
  }
  bool has_smooth_lobe() const override { return false; }
  bool passes_straight() const override { return true; }
  Rgb straight_transmittance(const Vec3& /*wo*/, const Vec2& /*uv*/) const override {
    return Rgb{1.0f};
  }
  Rgb albedo(const Vec2& /*uv*/) const override { return Rgb{1.0f}; }
};

}  // namespace brume
