// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/vec.h"

namespace brume {

enum class MicrofacetType { kBeckmann, kGgx };

/// Statistics of the microfacets of a rough surface: how their normals are distributed, and how
/// much they hide each other (Walter et al. 2007; Heitz 2014). Local frame, +Z the mean normal.
class Microfacets {
 public:
  /// `alpha_u`, `alpha_v` are the roughnesses along x and y; for Beckmann, equal ones are the RMS
  /// slope. Below 1e-4, where float directions no longer resolve the lobe, 1e-4 is used.
  Microfacets(MicrofacetType type, float alpha_u, float alpha_v);

  /// Density of microfacet area with normal `m` [1/sr]; 0 below the horizon.
  float D(const Vec3& m) const;

  /// Fraction of the facets with normal `m` facing `v` that is not hidden, in [0, 1] (Smith);
  /// 0 for the back of a facet seen from the front and conversely. `v` may be on either side.
  float G1(const Vec3& v, const Vec3& m) const;

  /// A normal seen from `wo`, wo.z > 0, with density `pdf_visible`.
  Vec3 sample_visible(const Vec3& wo, const Vec2& u) const;
  /// Density of normals seen from `wo` [1/sr]; `wo` may be on either side.
  float pdf_visible(const Vec3& wo, const Vec3& m) const;
  /// Density of the mirror images of `wo` in the normals seen from it [1/sr]; both directions lie
  /// above the surface.
  float pdf_reflection(const Vec3& wo, const Vec3& wi) const;
  /// Bsdf::mirror_lobe of those mirror images.
  float mirror_lobe() const;

 private:
  MicrofacetType type_;
  float alpha_u_, alpha_v_;
};

}  // namespace brume
