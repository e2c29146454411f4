// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/rng.h"
#include "geometry/ray_queries.h"
#include "geometry/shape.h"
#include "light/area_light.h"
#include "light/light_set.h"
#include "material/bsdf.h"
#include "medium/medium.h"
#include "scene/requirements.h"
#include "scene/scene_parts.h"

namespace brume {

/// Everything an integrator asks about the world. Immutable; shared between threads. Without
/// surfaces no acceleration structure exists.
class Scene {
 public:
  explicit Scene(SceneParts parts);

  /// Nearest surface point along `ray` in (0, t_max).
  std::optional<Hit> intersect(const Ray& ray, float t_max) const;

  /// As `Hit::shape` counts them: in the order of the scene's parts, but lights first and what is
  /// not seen last.
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const Bsdf& bsdf(const Hit& hit) const { return *surfaces_[hit.shape].bsdf; }
  /// Whether the medium changes at the surface, or at another in the same place.
  bool is_boundary(const Hit& hit) const;

  /// Medium behind the surface for light that crosses it in direction `d` out of `medium`. Of
  /// surfaces at the same place, one that the light enters has the say.
  const Medium* medium_across(const Hit& hit, const Vec3& d, const Medium* medium) const;

  /// Medium for light that left the surface in direction `d_out` after it arrived from `wo` (the
  /// direction back along which it came) through `medium`.
  const Medium* medium_toward(const Hit& hit, const Vec3& wo, const Vec3& d_out,
                              const Medium* medium) const {
    const bool crosses = glm::dot(wo, hit.n) * glm::dot(d_out, hit.n) < 0.0f;
    return crosses ? medium_across(hit, d_out, medium) : medium;
  }

  /// Medium at a point, found from the boundaries around it; null is vacuum. `unanimous` tells
  /// whether all boundaries agree, which they do when they are closed.
  struct MediumAt {
    const Medium* medium;
    bool unanimous;
  };
  MediumAt medium_at(const Vec3& p) const;

  /// Medium along a ray out of `medium` that meets no surface, however far it goes. What fills only
  /// the inside of closed surfaces ends with them: such a ray starts on a surface, or rounding has
  /// put it outside.
  const Medium* medium_to_infinity(const Medium* medium) const;

  /// Medium at `to`, a point near `from` where the medium is known.
  const Medium* medium_beside(const Vec3& from, const Medium* medium, const Vec3& to) const;

  /// Unbiased estimate of the fraction of light that crosses `distance` along `ray` from within
  /// `medium`: through media and through surfaces that let light pass straight. `similar` takes
  /// `Medium::similar` of each medium.
  Rgb transmittance(const Ray& ray, float distance, const Medium* medium, Rng& rng,
                    bool similar = false) const;

  /// Emission of the surface at `hit` toward the origin of a ray in direction `d`; nothing when the
  /// surface emits nothing that way.
  struct Emission {
    Rgb L;              // [W/(m^2 sr)]
    std::size_t light;  // in `lights()`
    float pdf;          // with which that light, once chosen, is sampled from `from` [1/sr]
  };
  std::optional<Emission> emission(const Vec3& from, const Hit& hit, const Vec3& d) const;

  const LightSet& lights() const { return lights_; }

  /// What rendering needs and why, for people.
  const std::vector<Requirement>& requirements() const { return requirements_; }

 private:
  std::vector<Requirement> requirements_;
  std::vector<Surface> surfaces_;
  std::shared_ptr<const Medium> world_medium_;
  std::vector<const Medium*> enclosed_;  // media that fill only the inside of closed surfaces
  bool has_opaque_;                      // whether any surface stops all light
  std::optional<RayQueries> queries_;
  std::vector<std::shared_ptr<const AreaLight>> area_lights_;  // [surface], null: emits nothing
  std::vector<std::size_t> light_index_;                       // [surface], in lights_
  LightSet lights_;
};

}  // namespace brume
