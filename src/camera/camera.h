// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/ray.h"

namespace brume {

/// Camera ray with the distance at which the far clip plane ends it.
struct CameraRay {
  Ray ray;
  float t_max = kInfinity;  // [unit]
};

class Camera {
 public:
  virtual ~Camera() = default;

  /// Ray through `film`, (0, 0) at the top left and (1, 1) at the bottom right of the picture;
  /// `u_lens` chooses the point on the aperture.
  virtual CameraRay ray(const Vec2& film, const Vec2& u_lens) const = 0;
};

}  // namespace brume
