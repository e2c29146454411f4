// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/sampler.h"
#include "scene/scene.h"

namespace brume {

/// A place where light from a lamp is about to scatter.
struct LightVertex {
  Vec3 p;                    // [unit]
  Vec3 d;                    // unit, along which the light arrives
  Rgb power;                 // that arrives; in a medium, less what is absorbed there [W]
  int scatterings;           // of the light, this one included
  const Medium* medium;      // through which it arrives; null is vacuum
  HenyeyGreenstein phase{};  // if it scatters in a medium
  std::optional<Hit> hit{};  // if it scatters at a surface
};

/// Part of the light that arrives at `vertex` which it scatters toward the unit direction `d`, over
/// the solid angle of the surface's area seen from there [1/sr]; Dirac lobes left out.
Rgb scattered_toward(const Scene& scene, const LightVertex& vertex, const Vec3& d);

/// Follows light from the lamps of a scene.
class LightTracer {
 public:
  /// `scene` must outlive the tracer. Light that has scattered more than `max_scatterings` times is
  /// not followed.
  LightTracer(const Scene& scene, int max_scatterings);

  struct Lamp {
    const Light* light;
    Vec3 p;                // somewhere on it [unit]
    const Medium* medium;  // around `p`
    float power;           // roughly, for a choice among lamps
    bool is_point;
  };
  /// None if some light of the scene comes from infinitely far away: such light is not followed,
  /// and what is found for the others would not stand for all.
  const std::vector<Lamp>& lamps() const { return lamps_; }

  /// Appends the places where a path from `lamp` may be connected to one from the camera. The path
  /// begins in the direction that `u_direction` chooses and counts `weight` times.
  void trace(const Lamp& lamp, const Vec2& u_direction, float weight, Sampler& sampler,
             std::vector<LightVertex>& vertices) const;

 private:
  struct Path;
  // Each returns whether the path goes on.
  bool scatter_in_medium(Path& path, const FreeFlight& flight, Sampler& sampler,
                         std::vector<LightVertex>& vertices) const;
  bool interact_with_surface(Path& path, const Hit& hit, Sampler& sampler,
                             std::vector<LightVertex>& vertices) const;
  bool survives_roulette(Path& path, Sampler& sampler) const;

  const Scene& scene_;
  int max_scatterings_;
  std::vector<Lamp> lamps_;
};

}  // namespace brume
