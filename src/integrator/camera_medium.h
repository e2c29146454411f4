// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.h"
#include "scene/scene.h"

namespace brume {

/// The medium in which camera rays begin. It is found once, at the middle of the picture, and
/// followed from there to the origin of each ray, which differs for a lens or a parallel view.
class CameraMedium {
 public:
  CameraMedium(const Scene& scene, const Camera& camera)
      : scene_(scene),
        anchor_(camera.ray(Vec2(0.5f), Vec2(0.5f)).ray.o),
        medium_(scene.medium_at(anchor_).medium) {}

  /// At the origin of `ray`; a camera exactly on a boundary sees both sides.
  const Medium* at(const Ray& ray) const {
    const Medium* medium = scene_.medium_beside(anchor_, medium_, ray.o);
    const Medium* beyond = scene_.medium_to_infinity(medium);
    return medium == beyond || scene_.intersect(ray, kInfinity) ? medium : beyond;
  }

 private:
  const Scene& scene_;
  Vec3 anchor_;
  const Medium* medium_;  // at `anchor_`
};

}  // namespace brume
