// SPDX-License-Identifier: Apache-2.0
#include "camera/orthographic_camera.h"

#include <cassert>

namespace brume {

OrthographicCamera::OrthographicCamera(const glm::dmat4& to_world, double aspect,
                                       const ClipRange& clip)
    : to_world_(to_world),
      aspect_(aspect),
      clip_(clip),
      d_(glm::normalize(glm::dvec3(to_world[2]))) {
  assert(aspect > 0.0 && clip.near >= 0.0 && clip.near < clip.far);
}

CameraRay OrthographicCamera::ray(const Vec2& film, const Vec2& /*u_lens*/) const {
  const glm::dvec4 o(1.0 - 2.0 * film.x, (1.0 - 2.0 * film.y) / aspect_, clip_.near, 1.0);
  return {.ray = {.o = Vec3(to_world_ * o), .d = d_},
          .t_max = static_cast<float>(clip_.far - clip_.near)};
}

}  // namespace brume
