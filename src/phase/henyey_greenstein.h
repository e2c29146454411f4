// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/frame.h"
#include "core/vec.h"
#include "core/warp.h"

namespace brume {

struct PhaseSample {
  Vec3 d;     // direction of travel after scattering
  float pdf;  // [1/sr], equal to the phase function; infinite for a Dirac
};

/// Phase function of Henyey and Greenstein (1941). `g` = E[cos theta] in [-1, 1], theta between
/// the directions of travel before and after: g > 0 scatters forward. At |g| = 1 it is a Dirac
/// that keeps (g = 1) or reverses (g = -1) the direction.
struct HenyeyGreenstein {
  float g = 0.0f;

  bool is_delta() const { return std::abs(g) == 1.0f; }
  bool keeps_direction() const { return g == 1.0f; }

  /// Phase function, which is also the density of `sample` [1/sr]; 0 for a Dirac.
  /// The denominator (1-g)^2 + 2g(1-cos) is positive whatever the rounding.
  float eval(const Vec3& d, const Vec3& d_out) const {
    if (is_delta()) return 0.0f;
    const float a = std::abs(g);
    const float x = one_minus_cos(d, g < 0.0f ? -d_out : d_out);
    const float denominator = (1.0f - a) * (1.0f - a) + 2.0f * a * x;
    return (1.0f - a) * (1.0f + a) / (4.0f * kPi * denominator * std::sqrt(denominator));
  }

  /// Inverse CDF of cos theta, (1/(2g)) (1 + g^2 - ((1-g^2)/(1-g+2gu))^2), rearranged as products
  /// for 1-cos and 1+cos so that neither cancels for any g, 0 and |g| -> 1 included
  /// (docs/theory.md, "Sampling Henyey-Greenstein").
  PhaseSample sample(const Vec3& d, const Vec2& u) const {
    if (is_delta()) return {.d = g * d, .pdf = kInfinity};
    const float a = std::abs(g);
    const float D = 1.0f - a + 2.0f * a * u.x;
    const float forward = (1.0f - a) / D;
    const float backward = (1.0f + a) / D;
    const float one_minus = 2.0f * forward * forward * (1.0f - u.x) * (1.0f + a * u.x);
    const float one_plus = 2.0f * backward * backward * u.x * (1.0f - a + a * u.x);
    const float cos_theta = one_minus < 1.0f ? 1.0f - one_minus : one_plus - 1.0f;
    const float sin_theta = std::sqrt(one_minus * one_plus);
    const Vec3 local =
        spherical_direction(sin_theta, std::copysign(1.0f, g) * cos_theta, 2.0f * kPi * u.y);
    const float pdf = D * D * D / (4.0f * kPi * (1.0f - a) * (1.0f - a) * (1.0f + a) * (1.0f + a));
    return {.d = glm::normalize(Frame(d).to_world(local)), .pdf = pdf};
  }
};

}  // namespace brume
