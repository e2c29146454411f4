// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "material/texture.h"

namespace brume {

/// The diffuse ground under the dielectric coat of plastic, with all the light that the coat
/// throws back at it from inside summed up.
class PlasticBase {
 public:
  /// `internal_reflectance` is that of the coat under diffuse light from inside. `nonlinear`
  /// colours every bounce, so that colours saturate; otherwise they stay as in the texture.
  PlasticBase(float eta, std::shared_ptr<const Texture> diffuse_reflectance, bool nonlinear,
              float internal_reflectance)
      : inv_eta2_(1.0f / (eta * eta)),
        internal_reflectance_(internal_reflectance),
        reflectance_(std::move(diffuse_reflectance)),
        nonlinear_(nonlinear) {}

  /// Reflectance of the ground alone.
  Rgb reflectance(const Vec2& uv) const { return reflectance_->value(uv); }

  /// Light that leaves in proportion to light that enters, to be multiplied by the transmittance
  /// of the coat for both directions and by cos / pi: d + d F d + ..., and 1 / eta^2 since the
  /// light spreads as it leaves.
  Rgb response(const Vec2& uv) const {
    const Rgb d = reflectance_->value(uv);
    const Rgb kept = internal_reflectance_ * (nonlinear_ ? d : Rgb{1.0f});
    return d * inv_eta2_ / (1.0f - kept);
  }

 private:
  float inv_eta2_, internal_reflectance_;
  std::shared_ptr<const Texture> reflectance_;
  bool nonlinear_;
};

}  // namespace brume
