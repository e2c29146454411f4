// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.h"
#include "camera/clip_range.h"

namespace brume {

/// What a pinhole and a thin lens have in common. The camera sits at the origin of its space,
/// looks along +Z and has +X to its left and +Y up (the convention of Mitsuba 3).
struct PerspectiveView {
  glm::dmat4 to_world{1.0};  // rigid, perhaps mirrored
  double x_fov;              // full horizontal angle [rad], in (0, pi)
  double aspect = 1.0;       // width / height of the picture
  ClipRange clip{};
  /// Where the optical axis meets the picture, from its centre, in widths to the left and heights
  /// upward, so that the view moves to the right and down.
  glm::dvec2 principal_point_offset{0.0};
};

/// Pinhole: every ray passes through the camera's position. The ray starts on the near plane.
class PerspectiveCamera final : public Camera {
 public:
  explicit PerspectiveCamera(const PerspectiveView& view);

  CameraRay ray(const Vec2& film, const Vec2& u_lens) const override;

 private:
  PerspectiveView view_;
};

/// Thin lens in the plane z = 0 of the camera: points at `focus_distance` along the optical axis
/// are sharp.
class ThinLensCamera final : public Camera {
 public:
  /// `aperture_radius` >= 0 and `focus_distance` > 0 in scene units.
  ThinLensCamera(const PerspectiveView& view, double aperture_radius, double focus_distance);

  CameraRay ray(const Vec2& film, const Vec2& u_lens) const override;

 private:
  PerspectiveView view_;
  double aperture_radius_;  // [unit]
  double focus_distance_;   // [unit]
};

}  // namespace brume
