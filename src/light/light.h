// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/ray.h"
#include "core/rgb.h"
#include "core/vec.h"

namespace brume {

/// Light arriving at a point, before anything in between takes its share.
struct LightSample {
  Vec3 d;          // unit, from the point toward the light
  float distance;  // to the light, less what rounding asks for [unit]; infinite for the environment
  Rgb weight;      // radiance / pdf; for a Dirac in direction, the perpendicular irradiance
  float pdf;       // of `d` in solid angle [1/sr]; infinite for a Dirac
};

/// Something that emits, seen from a point or sending out rays.
class Light {
 public:
  virtual ~Light() = default;

  /// Light arriving at `p` from a direction chosen by importance; nothing when none can arrive.
  virtual std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const = 0;

  /// Light that sets out along a ray.
  struct EmittedLight {
    Ray ray;
    Rgb power;  // (radiance x cosine, or intensity) / density of the ray [W]; black for no light
  };
  /// Light that leaves from an origin chosen by `u_point` into a direction chosen by `u_direction`,
  /// before anything takes its share; the mean of `power` is the power of the light. Nothing,
  /// whatever the numbers, for light from infinitely far away.
  virtual std::optional<EmittedLight> emit(const Vec2& /*u_point*/,
                                           const Vec2& /*u_direction*/) const {
    return std::nullopt;
  }

  /// Roughly the fluence at `p` if nothing stood in between, as luminance [W/m^2]; finite, and 0
  /// only where no light can arrive. It guides the choice among lights.
  virtual float importance(const Vec3& p) const = 0;

  /// Where the light is and how bright, for choosing points along a ray that are near to it, and
  /// for taking many lights for one.
  struct Pivot {
    Vec3 center;      // [unit]
    float radius;     // of the light around it, roughly [unit]
    float intensity;  // the importance far away, times squared distance, where it is largest [W]
    Vec3 axis{0.0f};  // unit, of the cone that all light leaves into, if there is one
    float cos_cutoff = 0.0f;  // of its half angle; 0 where there is none
  };
  /// Nothing for light from infinitely far away.
  virtual std::optional<Pivot> pivot() const { return std::nullopt; }
};

}  // namespace brume
