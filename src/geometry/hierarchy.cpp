// SPDX-License-Identifier: Apache-2.0
#include "geometry/hierarchy.h"

#include <embree3/rtcore.h>

#include <cassert>
#include <mutex>
#include <string>
#include <tuple>

#include "core/error.h"
#include "geometry/traversal_space.h"

namespace brume {
namespace {

[[noreturn]] void fail(RTCError code) {
  const std::string reason =
      code == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "Embree error " + std::to_string(code);
  throw Error("cannot build the ray tracing structure: " + reason, ErrorKind::kEnvironment);
}

/// One device for all hierarchies, for as long as there are any.
std::shared_ptr<RTCDeviceTy> shared_device() {
  static std::mutex mutex;
  static std::weak_ptr<RTCDeviceTy> existing;
  const std::lock_guard lock(mutex);
  if (auto device = existing.lock()) return device;
  const RTCDevice created = rtcNewDevice(nullptr);
  if (created == nullptr) fail(rtcGetDeviceError(nullptr));
  std::shared_ptr<RTCDeviceTy> device(created, rtcReleaseDevice);
  existing = device;
  return device;
}

/// What the Embree geometry points to.
struct Geometry {
  const Hierarchy::Items& items;
  TraversalSpace space;
};

/// A ray on its way. Embree hands the context through to the callbacks, and the rest with it:
/// Embree knows the ray in float only.
struct Query {
  RTCIntersectContext context;  // first, so that its address is that of the query
  const PreciseRay& ray;        // near the items
  double t_max;                 // crossings count in (0, t_max] along `ray` [unit]
  Hierarchy::Cluster* found;    // null where the obstacle alone is asked for
  Obstacle obstacle = Obstacle::kNone;

  Query(const PreciseRay& r, double t, Hierarchy::Cluster* cluster)
      : ray(r), t_max(t), found(cluster) {
    rtcInitIntersectContext(&context);
  }
};

const Geometry& geometry_of(void* pointer) {
  return *static_cast<const Geometry*>(pointer);
}
Query& query_of(RTCIntersectContext* context) {
  return *reinterpret_cast<Query*>(context);
}

void bound_item(const RTCBoundsFunctionArguments* args) {
  const Geometry& geometry = geometry_of(args->geometryUserPtr);
  const Box3 box = geometry.space.box(geometry.items.bounds(args->primID));
  *args->bounds_o = {.lower_x = box.min.x,
                     .lower_y = box.min.y,
                     .lower_z = box.min.z,
                     .align0 = 0.0f,
                     .upper_x = box.max.x,
                     .upper_y = box.max.y,
                     .upper_z = box.max.z,
                     .align1 = 0.0f};
}

void intersect_item(const RTCIntersectFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  const Geometry& geometry = geometry_of(args->geometryUserPtr);
  Query& query = query_of(args->context);
  const std::optional<Crossing> found =
      geometry.items.intersect(args->primID, query.ray, query.t_max);
  if (!found) return;
  query.found->add({args->primID, *found});
  query.t_max = std::min(query.t_max, query.found->reach());
  reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = geometry.space.distance(query.t_max);
}

void occlude_item(const RTCOccludedFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  Query& query = query_of(args->context);
  const Hierarchy::Items& items = geometry_of(args->geometryUserPtr).items;
  query.obstacle = std::max(query.obstacle, items.obstacle(args->primID, query.ray, query.t_max));
  // Which ends the search.
  if (query.obstacle == Obstacle::kOpaque) reinterpret_cast<RTCRay*>(args->ray)->tfar = -kInfinity;
}

Box3 bounds_of(const Hierarchy::Items& items) {
  Box3 box;
  for (std::uint32_t i = 0; i < items.count(); ++i) box.extend(items.bounds(i));
  return box;
}

RTCRay embree_ray(const Vec3& o, const Vec3d& d, float t_far) {
  return {.org_x = o.x,
          .org_y = o.y,
          .org_z = o.z,
          .tnear = 0.0f,
          .dir_x = static_cast<float>(d.x),
          .dir_y = static_cast<float>(d.y),
          .dir_z = static_cast<float>(d.z),
          .time = 0.0f,
          .tfar = t_far,
          .mask = ~0u,
          .id = 0,
          .flags = 0};
}

}  // namespace

struct Hierarchy::Impl {
  Geometry geometry;
  double cluster_width;  // [unit]
  std::shared_ptr<RTCDeviceTy> device = shared_device();
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene{rtcNewScene(device.get()),
                                                                rtcReleaseScene};

  Impl(const Items& items, Behind behind)
      : geometry{items, TraversalSpace(bounds_of(items))},
        cluster_width(behind == Behind::kFind ? geometry.space.coordinate_rounding() : 0.0) {
    const RTCGeometry user = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(user, items.count());
    rtcSetGeometryUserData(user, &geometry);
    rtcSetGeometryBoundsFunction(user, bound_item, nullptr);
    rtcSetGeometryIntersectFunction(user, intersect_item);
    rtcSetGeometryOccludedFunction(user, occlude_item);
    rtcCommitGeometry(user);
    rtcAttachGeometry(scene.get(), user);
    rtcReleaseGeometry(user);
    rtcCommitScene(scene.get());
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
      fail(error);
  }
};

void Hierarchy::Cluster::add(const ItemCrossing& added) {
  if (size_ == 0) {
    crossings_[size_++] = added;
    return;
  }
  const auto comes_before = [](const ItemCrossing& a, const ItemCrossing& b) {
    return std::tie(a.crossing.t, a.item) < std::tie(b.crossing.t, b.item);
  };
  std::size_t at = size_;
  while (at > 0 && comes_before(added, crossings_[at - 1])) --at;
  if (at == crossings_.size()) return;
  if (size_ < crossings_.size()) ++size_;
  for (std::size_t i = size_ - 1; i > at; --i) crossings_[i] = crossings_[i - 1];
  crossings_[at] = added;
  while (crossings_[size_ - 1].crossing.t > reach()) --size_;
}

Hierarchy::Hierarchy(const Items& items, Behind behind)
    : impl_(std::make_unique<const Impl>(items, behind)) {}
Hierarchy::~Hierarchy() = default;

std::optional<Hierarchy::Found> Hierarchy::nearest(const PreciseRay& ray, double t_max) const {
  std::optional<Found> found;
  const TraversalSpace& space = impl_->geometry.space;
  const auto local = space.ray(ray);
  if (!local || !(local->start < t_max)) return found;
  found.emplace(PreciseRay{.o = ray.at(local->start), .d = ray.d}, local->start,
                impl_->cluster_width);
  Query query(found->ray, t_max - local->start, &found->crossings);
  RTCRayHit embree{};
  embree.ray = embree_ray(local->o, ray.d, space.distance(query.t_max));
  embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene.get(), &query.context, &embree);
  if (found->crossings.empty()) found.reset();
  return found;
}

Obstacle Hierarchy::obstacle(const PreciseRay& ray, double t_max) const {
  const TraversalSpace& space = impl_->geometry.space;
  const auto local = space.ray(ray);
  if (!local || !(local->start < t_max)) return Obstacle::kNone;
  const PreciseRay near{.o = ray.at(local->start), .d = ray.d};
  Query query(near, t_max - local->start, nullptr);
  RTCRay embree = embree_ray(local->o, ray.d, space.distance(query.t_max));
  rtcOccluded1(impl_->scene.get(), &query.context, &embree);
  return query.obstacle;
}

}  // namespace brume
