// SPDX-License-Identifier: Apache-2.0
#include "geometry/disk.h"

#include "core/warp.h"
#include "geometry/area_sampling.h"

namespace brume {

Disk::Disk(const glm::dmat4& to_world, bool flip_normals)
    : patch_(to_world, flip_normals),
      area_(M_PI * glm::length(patch_.cross)),
      extent_(2.0 * std::hypot(glm::length(patch_.a), glm::length(patch_.b))) {}

Box3 Disk::bounds() const {
  // max over the circle of x a_i + y b_i
  const Vec3d reach = glm::sqrt(patch_.a * patch_.a + patch_.b * patch_.b);
  return rounded_outward(patch_.center - reach, patch_.center + reach);
}

std::optional<Crossing> Disk::intersect(const PreciseRay& ray, double t_max) const {
  const auto crossing = patch_.intersect(ray, t_max);
  if (!crossing || !(glm::dot(crossing->xy, crossing->xy) <= 1.0)) return std::nullopt;
  return Crossing{.t = crossing->t, .face = 0, .xy = crossing->xy};
}

Hit Disk::hit(const PreciseRay& /*ray*/, const Crossing& crossing) const {
  const Vec2d xy = crossing.xy;
  const double r = glm::length(xy);
  const Vec2d radial = r > 0.0 ? xy / r : Vec2d(1.0, 0.0);
  const float error = surface_error(Vec3(patch_.at(xy)), patch_.n, extent_);
  const double margin =
      kEdgeMargin * error * std::hypot(glm::length(patch_.a_dual), glm::length(patch_.b_dual));
  const double azimuth = std::atan2(xy.y, xy.x);
  return {.t = 0.0f,
          .p = Vec3(patch_.at(std::min(r, std::max(1.0 - margin, 0.0)) * radial)),
          .error = error,
          .n = patch_.n,
          .n_shading = patch_.n,
          .dp_du = Vec3(radial.x * patch_.a + radial.y * patch_.b),
          .uv = Vec2(r, (azimuth < 0.0 ? azimuth + 2.0 * M_PI : azimuth) / (2.0 * M_PI)),
          .shape = 0};
}

SurfacePoint Disk::sample_area(const Vec2& u) const {
  const Vec3 p(patch_.at(sample_disk(u)));
  return {.p = p, .n = patch_.n, .error = surface_error(p, patch_.n, extent_)};
}

std::optional<ShapeSample> Disk::sample_toward(const Vec3& from, const Vec2& u) const {
  return sample_by_area(from, sample_area(u), area_);
}

float Disk::pdf_toward(const Vec3& from, const Hit& hit) const {
  return solid_angle_pdf(from, hit.p, hit.n, area_);
}

}  // namespace brume
