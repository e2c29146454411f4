// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

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

/// Sees from one point in all directions alike: the mean radiance is the fluence there, divided by
/// 4 pi.
class FluenceCamera final : public Camera {
 public:
  explicit FluenceCamera(const Vec3& position) : position_(position) {}

  CameraRay ray(const Vec2& film, const Vec2& /*u_lens*/) const override {
    return {.ray = {.o = position_, .d = sample_uniform_sphere(film)}};
  }

 private:
  Vec3 position_;  // [unit]
};

/// Rays that enter a convex body as isotropic light does: uniform over its surface, in proportion
/// to their cosine. They start a little before it.
inline CameraRay entering_ray(const Vec3& p, const Vec3& outside, const Vec2& u) {
  constexpr float kBefore = 1e-2f;  // [unit]
  const Vec3 d = glm::normalize(Frame(-outside).to_world(sample_cosine_hemisphere(u)));
  return {.ray = {.o = p - kBefore * d, .d = d}};
}

/// Isotropic light that enters the unit sphere around the origin.
class SphereEntryCamera final : public Camera {
 public:
  CameraRay ray(const Vec2& film, const Vec2& u_lens) const override {
    const Vec3 n = sample_uniform_sphere(film);
    return entering_ray(n, n, u_lens);
  }
};

/// Isotropic light that enters the box [-half, half].
class BoxEntryCamera final : public Camera {
 public:
  explicit BoxEntryCamera(const Vec3& half) : half_(half) {}

  CameraRay ray(const Vec2& film, const Vec2& u_lens) const override {
    const Vec3 area(half_.y * half_.z, half_.z * half_.x, half_.x * half_.y);
    float u = film.x * (area.x + area.y + area.z);
    int axis = 0;
    while (axis < 2 && u >= area[axis]) u -= area[axis++];
    u = std::min(u / area[axis], kOneMinusEpsilon);  // what is left chooses the side and a place
    Vec3 n(0.0f), p;
    n[axis] = u < 0.5f ? -1.0f : 1.0f;
    p[axis] = n[axis] * half_[axis];
    p[(axis + 1) % 3] = half_[(axis + 1) % 3] * (4.0f * std::fmod(u, 0.5f) - 1.0f);
    p[(axis + 2) % 3] = half_[(axis + 2) % 3] * (2.0f * film.y - 1.0f);
    return entering_ray(p, n, u_lens);
  }

 private:
  Vec3 half_;  // [unit]
};

}  // namespace brume::test
