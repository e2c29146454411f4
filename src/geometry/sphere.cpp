// SPDX-License-Identifier: Apache-2.0
#include "geometry/sphere.h"

#include <cassert>

#include "core/frame.h"
#include "core/warp.h"
#include "geometry/area_sampling.h"

namespace brume {

Sphere::Sphere(const Vec3& center, float radius, bool flip_normals, const glm::mat3& orientation)
    : center_(center),
      radius_(radius),
      area_(4.0 * M_PI * radius_ * radius_),
      flip_normals_(flip_normals),
      orientation_(orientation) {
  assert(radius > 0.0f);
}

Box3 Sphere::bounds() const {
  return rounded_outward(center_ - radius_, center_ + radius_);
}

std::optional<Crossing> Sphere::intersect(const PreciseRay& ray, double t_max) const {
  const auto crossings = crossings_of_ball(ray.o - center_, ray.d, radius_);
  if (!crossings) return std::nullopt;
  const double t = crossings->first > 0.0 ? crossings->first : crossings->second;
  if (!(t > 0.0 && t <= t_max)) return std::nullopt;
  return Crossing{.t = t, .face = 0, .xy{}};
}

Hit Sphere::hit(const PreciseRay& ray, const Crossing& crossing) const {
  const Vec3d outward = glm::normalize(ray.at(crossing.t) - center_);
  const Vec3 p(center_ + radius_ * outward);
  const Vec3 n(flip_normals_ ? -outward : outward);

  const Vec3 local = Vec3(outward) * orientation_;  // by the transpose: to local axes
  const float azimuth = std::atan2(local.y, local.x);
  const float angle = std::atan2(std::hypot(local.x, local.y), local.z);
  return {.t = 0.0f,
          .p = p,
          .error = surface_error(p, n, 2.0 * radius_),
          .n = n,
          .n_shading = n,
          .dp_du = orientation_ * Vec3(-local.y, local.x, 0.0f) * float(2.0 * M_PI * radius_),
          .uv = Vec2((azimuth < 0.0f ? azimuth + 2.0f * kPi : azimuth) / (2.0f * kPi), angle / kPi),
          .shape = 0};
}

std::optional<Sphere::Cone> Sphere::cone_from(const Vec3& from) const {
  const Vec3d way = Vec3d(from) - center_;
  const double distance = glm::length(way);
  if (!(distance > radius_)) return std::nullopt;
  const double sine = radius_ / distance;
  const double cosine = std::sqrt((distance - radius_) * (distance + radius_)) / distance;
  return Cone{
      .axis = way / distance, .sin2 = sine * sine, .one_minus_cos = sine * sine / (1.0 + cosine)};
}

SurfacePoint Sphere::sample_area(const Vec2& u) const {
  const Vec3 outward = sample_uniform_sphere(u);
  const Vec3 p(center_ + radius_ * glm::normalize(Vec3d(outward)));
  const Vec3 n = flip_normals_ ? -outward : outward;
  return {.p = p, .n = n, .error = surface_error(p, n, 2.0 * radius_)};
}

std::optional<ShapeSample> Sphere::sample_toward(const Vec3& from, const Vec2& u) const {
  const std::optional<Cone> cone = cone_from(from);
  if (!cone) return sample_by_area(from, sample_area(u), area_);

  // The direction makes the angle theta with the axis and meets the surface at the angle beta
  // from its normal, sin beta = sin theta / sin theta_max (law of sines). Seen from the center,
  // the point is beta - theta away from the axis.
  const double one_minus_cos = u.x * cone->one_minus_cos;
  const double sin2_theta = one_minus_cos * (2.0 - one_minus_cos);
  const double sin2_beta = std::min(1.0, sin2_theta / cone->sin2);
  const double sin_theta = std::sqrt(sin2_theta), cos_theta = 1.0 - one_minus_cos;
  const double sin_beta = std::sqrt(sin2_beta), cos_beta = std::sqrt(1.0 - sin2_beta);
  const Vec3 local = spherical_direction(
      static_cast<float>(sin_beta * cos_theta - cos_beta * sin_theta),
      static_cast<float>(cos_beta * cos_theta + sin_beta * sin_theta), 2.0f * kPi * u.y);
  const Vec3 outward = Frame(Vec3(cone->axis)).to_world(local);

  const Vec3 p(center_ + radius_ * glm::normalize(Vec3d(outward)));
  const Vec3 n = glm::normalize(flip_normals_ ? -outward : outward);
  return ShapeSample{.p = p,
                     .n = n,
                     .error = surface_error(p, n, 2.0 * radius_),
                     .pdf = static_cast<float>(cone->pdf())};
}

float Sphere::pdf_toward(const Vec3& from, const Hit& hit) const {
  if (const std::optional<Cone> cone = cone_from(from)) return static_cast<float>(cone->pdf());
  return solid_angle_pdf(from, hit.p, hit.n, area_);
}

}  // namespace brume
