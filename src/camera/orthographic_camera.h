// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.h"
#include "camera/clip_range.h"

namespace brume {

/// Parallel rays along +Z of the camera, with +X to the left and +Y up. The picture spans [-1, 1]
/// in x and [-1, 1] / aspect in y before `to_world`, whose scale sets its size.
class OrthographicCamera final : public Camera {
 public:
  /// `to_world` is affine; `aspect` = width / height of the picture. As in Mitsuba 3, the near
  /// plane is placed before `to_world` and the range behind it has its length in the world.
  OrthographicCamera(const glm::dmat4& to_world, double aspect, const ClipRange& clip);

  CameraRay ray(const Vec2& film, const Vec2& u_lens) const override;

 private:
  glm::dmat4 to_world_;
  double aspect_;
  ClipRange clip_;
  Vec3 d_;  // of every ray, unit
};

}  // namespace brume
