// SPDX-License-Identifier: Apache-2.0
#include "geometry/rectangle.h"

#include "geometry/area_sampling.h"

namespace brume {

Rectangle::Rectangle(const glm::dmat4& to_world, bool flip_normals)
    : patch_(to_world, flip_normals),
      area_(4.0 * glm::length(patch_.cross)),
      extent_(2.0 * std::max(glm::length(patch_.a + patch_.b), glm::length(patch_.a - patch_.b))),
      is_right_angled_(std::abs(glm::dot(patch_.a, patch_.b)) <=
                       1e-9 * glm::length(patch_.a) * glm::length(patch_.b)) {}

Box3 Rectangle::bounds() const {
  const Vec3d reach = glm::abs(patch_.a) + glm::abs(patch_.b);
  return rounded_outward(patch_.center - reach, patch_.center + reach);
}

std::optional<Crossing> Rectangle::intersect(const PreciseRay& ray, double t_max) const {
  const auto crossing = patch_.intersect(ray, t_max);
  if (!crossing || !(std::abs(crossing->xy.x) <= 1.0 && std::abs(crossing->xy.y) <= 1.0))
    return std::nullopt;
  return Crossing{.t = crossing->t, .face = 0, .xy = crossing->xy};
}

Hit Rectangle::hit(const PreciseRay& /*ray*/, const Crossing& crossing) const {
  const Vec2d xy = crossing.xy;
  const float error = surface_error(Vec3(patch_.at(xy)), patch_.n, extent_);
  const Vec2d margin = glm::min(
      kEdgeMargin * error * Vec2d(glm::length(patch_.a_dual), glm::length(patch_.b_dual)), 1.0);
  return {.t = 0.0f,
          .p = Vec3(patch_.at(glm::clamp(xy, margin - 1.0, 1.0 - margin))),
          .error = error,
          .n = patch_.n,
          .n_shading = patch_.n,
          .dp_du = Vec3(2.0 * patch_.a),
          .uv = Vec2(0.5 * xy + 0.5),
          .shape = 0};
}

std::optional<SphericalRectangle> Rectangle::seen_from(const Vec3& from) const {
  if (!is_right_angled_) return std::nullopt;
  // Far away, or nearly edge on, the solid angle is a small difference of large angles, and
  // sampling by area is as good.
  constexpr double kMinSolidAngle = 1e-4;  // [sr]
  SphericalRectangle seen(from, patch_.center, patch_.a, patch_.b);
  if (seen.solid_angle() < kMinSolidAngle) return std::nullopt;
  return seen;
}

SurfacePoint Rectangle::point_at(const Vec2d& xy) const {
  const Vec3 p(patch_.at(xy));
  return {.p = p, .n = patch_.n, .error = surface_error(p, patch_.n, extent_)};
}

SurfacePoint Rectangle::sample_area(const Vec2& u) const {
  return point_at(2.0 * Vec2d(u) - 1.0);
}

std::optional<ShapeSample> Rectangle::sample_toward(const Vec3& from, const Vec2& u) const {
  const std::optional<SphericalRectangle> seen = seen_from(from);
  if (!seen) return sample_by_area(from, sample_area(u), area_);
  const SurfacePoint point = point_at(seen->sample(u));
  return ShapeSample{.p = point.p,
                     .n = point.n,
                     .error = point.error,
                     .pdf = static_cast<float>(1.0 / seen->solid_angle())};
}

float Rectangle::pdf_toward(const Vec3& from, const Hit& hit) const {
  if (const auto seen = seen_from(from)) return static_cast<float>(1.0 / seen->solid_angle());
  return solid_angle_pdf(from, hit.p, hit.n, area_);
}

}  // namespace brume
