// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"
#include "core/vec.h"

namespace brume {

/// What a smooth boundary between two dielectrics does with a direction.
struct DielectricFresnel {
  float R;      // unpolarised reflectance, [0, 1]; 1 under total internal reflection
  float cos_t;  // of the transmitted direction, sign opposite to cos_i; 0 when there is none
  float eta;    // relative index of refraction, far side over the side of cos_i
};

/// `cos_i` in [-1, 1] is positive outside; `eta` > 0 is the index inside over that outside.
DielectricFresnel fresnel_dielectric(float cos_i, float eta);

/// Unpolarised reflectance of a conductor with the relative complex index `eta` + i `k`;
/// `cos_i` in [0, 1].
Rgb fresnel_conductor(float cos_i, const Rgb& eta, const Rgb& k);

/// Reflectance under diffuse light from outside: the mean of `fresnel_dielectric` weighted by the
/// cosine. For light from inside pass 1 / `eta`.
float diffuse_fresnel_reflectance(float eta);

/// Mirror image of `w` about the unit normal `m`.
inline Vec3 reflect(const Vec3& w, const Vec3& m) {
  return 2.0f * glm::dot(w, m) * m - w;
}
/// Mirror image of `w` about +Z.
inline Vec3 reflect(const Vec3& w) {
  return {-w.x, -w.y, w.z};
}

/// Where `w` continues behind a boundary with the unit normal `m`; `fresnel` belongs to dot(w, m).
inline Vec3 refract(const Vec3& w, const Vec3& m, const DielectricFresnel& fresnel) {
  return (glm::dot(w, m) / fresnel.eta + fresnel.cos_t) * m - w / fresnel.eta;
}
inline Vec3 refract(const Vec3& w, const DielectricFresnel& fresnel) {
  return {-w.x / fresnel.eta, -w.y / fresnel.eta, fresnel.cos_t};
}

}  // namespace brume
