// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.h"
#include "core/frame.h"
#include "core/warp.h"

// Cameras that integrate: the point on their film chooses the ray.

namespace brume::test {

/// Sees from one point in all directions of a hemisphere, in proportion to their cosine: the mean
/// radiance is the irradiance there, divided by pi.
class IrradianceCamera final : public Camera {
 public:
  IrradianceCamera(const Vec3& position, const Vec3& axis) : position_(position), frame_(axis) {}

  CameraRay ray(const Vec2& film, const Vec2& /*u_lens*/) const override {
    return {.ray = {.o = position_,
                    .d = glm::normalize(frame_.to_world(sample_cosine_hemisphere(film)))}};
  }

 private:
  Vec3 position_;  // [unit]
  Frame frame_;    // +Z is the axis
};

}  // namespace brume::test
