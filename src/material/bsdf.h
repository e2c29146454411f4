// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/rgb.h"
#include "core/vec.h"

namespace brume {

struct BsdfSample {
  Vec3 wi;                // unit, away from the surface, local frame
  Rgb weight;             // f |cos theta_i| / pdf
  float pdf;              // [1/sr], of all lobes that can produce `wi`; infinite for a Dirac lobe
  float eta = 1.0f;       // relative index of refraction from the side of `wo` to that of `wi`
  bool straight = false;  // passed through as if nothing were there
};

/// How a surface scatters. Directions are unit, point away from the surface, and stand in the
/// local frame whose +Z is the shading normal on the outside; uv are the surface parameters.
class Bsdf {
 public:
  virtual ~Bsdf() = default;

  /// f(wo, wi) |cos theta_i| [1/sr], Dirac lobes left out.
  virtual Rgb eval(const Vec3& wo, const Vec3& wi, const Vec2& uv) const = 0;
  /// Density of `sample` in solid angle [1/sr], Dirac lobes left out.
  virtual float pdf(const Vec3& wo, const Vec3& wi, const Vec2& uv) const = 0;
  /// A direction; nothing when the light is absorbed. `u_lobe` chooses among lobes.
  virtual std::optional<BsdfSample> sample(const Vec3& wo, const Vec2& uv, float u_lobe,
                                           const Vec2& u) const = 0;

  /// Whether `eval` is nonzero anywhere, that is whether next-event estimation can help.
  virtual bool has_smooth_lobe() const { return true; }
  /// Whether reflected light is spread as by Lambert's law, on one side or on both.
  virtual bool is_diffuse() const { return false; }
  /// Mean cosine, in [0, 1), of a Henyey-Greenstein lobe around the mirror direction that resembles
  /// all that is reflected, rather too wide than too narrow; nothing where no such lobe does.
  virtual std::optional<float> mirror_lobe() const { return std::nullopt; }
  /// Whether `straight_transmittance` is nonzero anywhere: such a surface must be looked at, where
  /// any other may be taken for opaque to shadow rays.
  virtual bool passes_straight() const { return false; }
  /// Fraction of the light along -wo that passes straight through: 1 for an index-matched
  /// boundary, 0 for most surfaces. `sample` returns that light with `straight` set.
  virtual Rgb straight_transmittance(const Vec3& /*wo*/, const Vec2& /*uv*/) const {
    return Rgb{0.0f};
  }
  /// Fraction of light reflected and transmitted, roughly, for the albedo layer; in [0, 1].
  virtual Rgb albedo(const Vec2& uv) const = 0;
};

}  // namespace brume
