// SPDX-License-Identifier: Apache-2.0
#include "geometry/cylinder.h"

#include <cassert>

#include "core/frame.h"
#include "geometry/area_sampling.h"

namespace brume {
namespace {

/// Orthonormal in double, with the axes of `Frame` around `along`.
Mat3d axes_around(const Vec3d& along) {
  const Vec3d z = glm::normalize(along);
  const Vec3d s(Frame(Vec3(z)).s);
  const Vec3d x = glm::normalize(s - glm::dot(s, z) * z);
  return Mat3d(x, glm::cross(z, x), z);
}

}  // namespace

Cylinder::Cylinder(const Vec3& p0, const Vec3& p1, float radius, const Similarity& to_world,
                   bool flip_normals)
    : base_(to_world.offset + to_world.scale * (to_world.rotation * Vec3d(p0))),
      axes_(to_world.rotation * axes_around(Vec3d(p1) - Vec3d(p0))),
      radius_(to_world.scale * radius),
      length_(to_world.scale * glm::length(Vec3d(p1) - Vec3d(p0))),
      area_(2.0 * M_PI * radius_ * length_),
      extent_(std::hypot(2.0 * radius_, length_)),
      flip_normals_(flip_normals) {
  assert(radius > 0.0f && p0 != p1);
}

Box3 Cylinder::bounds() const {
  const Vec3d reach = radius_ * glm::sqrt(axes_[0] * axes_[0] + axes_[1] * axes_[1]);
  const Vec3d top = base_ + length_ * axes_[2];
  return rounded_outward(glm::min(base_, top) - reach, glm::max(base_, top) + reach);
}

std::optional<Crossing> Cylinder::intersect(const PreciseRay& ray, double t_max) const {
  const Vec3d o = to_local(ray.o - base_), d = to_local(ray.d);
  const auto crossings = crossings_of_ball(Vec2d(o), Vec2d(d), radius_);
  if (!crossings) return std::nullopt;
  for (const double t : {crossings->first, crossings->second}) {
    const double z = o.z + t * d.z;
    if (t > 0.0 && t <= t_max && z >= 0.0 && z <= length_)
      return Crossing{.t = t, .face = 0, .xy{}};
  }
  return std::nullopt;
}

Hit Cylinder::hit(const PreciseRay& ray, const Crossing& crossing) const {
  const Vec3d local = to_local(ray.at(crossing.t) - base_);
  const Vec2d radial = glm::normalize(Vec2d(local));
  const Vec3d outward = radial.x * axes_[0] + radial.y * axes_[1];
  const Vec3 n(flip_normals_ ? -outward : outward);
  const float error = surface_error(point(outward, local.z), n, extent_);
  const double margin = std::min(kEdgeMargin * error, 0.5 * length_);
  const double azimuth = std::atan2(local.y, local.x);
  return {.t = 0.0f,
          .p = point(outward, std::clamp(local.z, margin, length_ - margin)),
          .error = error,
          .n = n,
          .n_shading = n,
          .dp_du = Vec3(2.0 * M_PI * radius_ * (radial.x * axes_[1] - radial.y * axes_[0])),
          .uv = Vec2((azimuth < 0.0 ? azimuth + 2.0 * M_PI : azimuth) / (2.0 * M_PI),
                     local.z / length_),
          .shape = 0};
}

SurfacePoint Cylinder::sample_area(const Vec2& u) const {
  const double phi = 2.0 * M_PI * u.x;
  const Vec3d outward = std::cos(phi) * axes_[0] + std::sin(phi) * axes_[1];
  const Vec3 p = point(outward, u.y * length_);
  const Vec3 n(flip_normals_ ? -outward : outward);
  return {.p = p, .n = n, .error = surface_error(p, n, extent_)};
}

std::optional<ShapeSample> Cylinder::sample_toward(const Vec3& from, const Vec2& u) const {
  return sample_by_area(from, sample_area(u), area_);
}

float Cylinder::pdf_toward(const Vec3& from, const Hit& hit) const {
  return solid_angle_pdf(from, hit.p, hit.n, area_);
}

}  // namespace brume
