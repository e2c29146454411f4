// SPDX-License-Identifier: Apache-2.0
#include "geometry/traversal_space.h"

#include <algorithm>
#include <cassert>

namespace brume {

TraversalSpace::TraversalSpace(const Box3& scene)
    : center_(0.5 * (Vec3d(scene.min) + Vec3d(scene.max))) {
  assert(!scene.empty());
  const Vec3d size = Vec3d(scene.max) - Vec3d(scene.min);
  extent_ = std::max({size.x, size.y, size.z});
  if (extent_ > 0.0) scale_ = std::ldexp(1.0f, -std::ilogb(extent_));

  // Within kReach + 1/2 extents of a center that is four times as far from 0, any coordinate is
  // between half and twice any other.
  for (int i = 0; i < 3; ++i)
    if (std::abs(center_[i]) > 4.0 * (kReach + 0.5) * extent_)
      shift_[i] = static_cast<float>(center_[i]);
}

std::optional<TraversalSpace::NearRay> TraversalSpace::near(const Ray& ray) const {
  const Vec3d o = Vec3d(ray.o) - center_;
  const double reach = kReach * extent_;
  if (std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) <= reach)
    return NearRay{.ray = ray, .t = 0.0};

  const Vec3d d(ray.d);
  double t_enter = 0.0, t_leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0) {
      if (std::abs(o[i]) > reach) return std::nullopt;
      continue;
    }
    const double t0 = (-reach - o[i]) / d[i], t1 = (reach - o[i]) / d[i];
    t_enter = std::max(t_enter, std::min(t0, t1));
    t_leave = std::min(t_leave, std::max(t0, t1));
  }
  if (t_enter > t_leave) return std::nullopt;
  return NearRay{.ray = {.o = Vec3(Vec3d(ray.o) + t_enter * d), .d = ray.d}, .t = t_enter};
}

}  // namespace brume
