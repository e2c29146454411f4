// SPDX-License-Identifier: Apache-2.0
#include "camera/perspective_camera.h"

#include <cassert>
#include <cmath>

#include "core/warp.h"

namespace brume {
namespace {

/// Point seen at `film` by a pinhole, on the plane z = 1 of the camera.
glm::dvec3 point_at_unit_depth(const PerspectiveView& view, const Vec2& film) {
  const glm::dvec2 p = glm::dvec2(film) + view.principal_point_offset;
  const double half_width = std::tan(0.5 * view.x_fov);
  return {(1.0 - 2.0 * p.x) * half_width, (1.0 - 2.0 * p.y) * half_width / view.aspect, 1.0};
}

/// Ray from `o` along the unit vector `d`, both in camera space, between the clip planes.
CameraRay clipped_ray(const PerspectiveView& view, const glm::dvec3& o, const glm::dvec3& d) {
  const double t_near = view.clip.near / d.z;
  const double t_far = view.clip.far / d.z;
  return {.ray = {.o = Vec3(view.to_world * glm::dvec4(o + t_near * d, 1.0)),
                  .d = Vec3(glm::normalize(glm::dmat3(view.to_world) * d))},
          .t_max = static_cast<float>(t_far - t_near)};
}

void check(const PerspectiveView& view) {
  assert(view.x_fov > 0.0 && view.x_fov < M_PI && view.aspect > 0.0);
  assert(view.clip.near >= 0.0 && view.clip.near < view.clip.far);
  static_cast<void>(view);
}

}  // namespace

PerspectiveCamera::PerspectiveCamera(const PerspectiveView& view) : view_(view) {
  check(view);
}

CameraRay PerspectiveCamera::ray(const Vec2& film, const Vec2& /*u_lens*/) const {
  return clipped_ray(view_, glm::dvec3(0.0), glm::normalize(point_at_unit_depth(view_, film)));
}

ThinLensCamera::ThinLensCamera(const PerspectiveView& view, double aperture_radius,
                               double focus_distance)
    : view_(view), aperture_radius_(aperture_radius), focus_distance_(focus_distance) {
  check(view);
  assert(aperture_radius >= 0.0 && focus_distance > 0.0);
}

CameraRay ThinLensCamera::ray(const Vec2& film, const Vec2& u_lens) const {
  const glm::dvec2 disk = aperture_radius_ * glm::dvec2(sample_disk(u_lens));
  const glm::dvec3 on_lens(disk.x, disk.y, 0.0);
  const glm::dvec3 in_focus = focus_distance_ * point_at_unit_depth(view_, film);
  return clipped_ray(view_, on_lens, glm::normalize(in_focus - on_lens));
}

}  // namespace brume
