// SPDX-License-Identifier: Apache-2.0
#include "geometry/traversal_space.h"

#include <algorithm>
#include <cassert>

namespace brume {

TraversalSpace::TraversalSpace(const Box3& world)
    : center_(0.5 * (Vec3d(world.min) + Vec3d(world.max))) {
  assert(!world.empty());
  const Vec3d size = Vec3d(world.max) - Vec3d(world.min);
  const double extent = std::max({size.x, size.y, size.z});
  if (extent > 0.0) scale_ = 1.0 / extent;
}

Box3 TraversalSpace::box(const Box3& world) const {
  return rounded_outward(scale_ * (Vec3d(world.min) - center_) - kPadding,
                         scale_ * (Vec3d(world.max) - center_) + kPadding);
}

std::optional<TraversalSpace::LocalRay> TraversalSpace::ray(const PreciseRay& world) const {
  const Vec3d o = scale_ * (world.o - center_);
  if (std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)}) <= kReach)
    return LocalRay{.o = Vec3(o), .start = 0.0};

  double t_enter = 0.0, t_leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (world.d[i] == 0.0) {
      if (std::abs(o[i]) > kReach) return std::nullopt;
      continue;
    }
    const double t0 = (-kReach - o[i]) / world.d[i], t1 = (kReach - o[i]) / world.d[i];
    t_enter = std::max(t_enter, std::min(t0, t1));
    t_leave = std::min(t_leave, std::max(t0, t1));
  }
  if (t_enter > t_leave) return std::nullopt;
  return LocalRay{.o = Vec3(o + t_enter * world.d), .start = t_enter / scale_};
}

}  // namespace brume
