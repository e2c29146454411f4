// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray_queries.h"

#include <embree3/rtcore.h>

#include <cassert>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "geometry/traversal_space.h"

namespace brume {
namespace {

/// What an Embree geometry points to.
struct Geometry {
  std::shared_ptr<const Shape> shape;
  const TraversalSpace* space;
};

/// A ray on its way. Embree hands the context through to the callbacks, and the rest with it:
/// Embree knows the ray in float only, the shapes want it in double.
struct Query {
  RTCIntersectContext context;  // first, so that its address is that of the query
  PreciseRay ray;
  double t_max;  // crossings count in (0, t_max] [unit]
  std::optional<Crossing> nearest{};
  std::uint32_t shape = 0;  // of `nearest`

  Query(const Ray& r, double t_exclusive)
      : ray{.o = Vec3d(r.o), .d = Vec3d(r.d)}, t_max(std::nextafter(t_exclusive, 0.0)) {
    rtcInitIntersectContext(&context);
  }
};

const Geometry& geometry_of(void* user_pointer) {
  return *static_cast<Geometry*>(user_pointer);
}
Query& query_of(RTCIntersectContext* context) {
  return *reinterpret_cast<Query*>(context);
}

void bound_piece(const RTCBoundsFunctionArguments* args) {
  const Geometry& geometry = geometry_of(args->geometryUserPtr);
  const Box3 box = geometry.space->from_world(geometry.shape->piece_bounds(args->primID));
  *args->bounds_o = {.lower_x = box.min.x,
                     .lower_y = box.min.y,
                     .lower_z = box.min.z,
                     .align0 = 0.0f,
                     .upper_x = box.max.x,
                     .upper_y = box.max.y,
                     .upper_z = box.max.z,
                     .align1 = 0.0f};
}

void intersect_piece(const RTCIntersectFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  const Geometry& geometry = geometry_of(args->geometryUserPtr);
  Query& query = query_of(args->context);
  const std::optional<Crossing> found =
      geometry.shape->intersect(query.ray, args->primID, query.t_max);
  if (!found) return;

  // Ties go to the first, whatever the order in which the hierarchy is walked.
  if (query.nearest && std::tie(query.nearest->t, query.shape, query.nearest->face) <
                           std::tie(found->t, args->geomID, found->face))
    return;
  query.nearest = found;
  query.shape = args->geomID;
  query.t_max = found->t;
  reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = geometry.space->from_world(found->t);
}

void occlude_piece(const RTCOccludedFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  const Query& query = query_of(args->context);
  if (geometry_of(args->geometryUserPtr).shape->intersect(query.ray, args->primID, query.t_max))
    reinterpret_cast<RTCRay*>(args->ray)->tfar = -kInfinity;
}

[[noreturn]] void fail(RTCError code) {
  const std::string reason =
      code == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "Embree error " + std::to_string(code);
  throw Error("cannot build the ray tracing structure: " + reason, ErrorKind::kEnvironment);
}

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

Box3 bounds_of(std::span<const std::shared_ptr<const Shape>> shapes) {
  Box3 box;
  for (const auto& shape : shapes) box.extend(shape->bounds());
  return box;
}

}  // namespace

struct RayQueries::Impl {
  TraversalSpace space;
  std::vector<Geometry> geometries;
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;

  explicit Impl(std::span<const std::shared_ptr<const Shape>> shapes) : space(bounds_of(shapes)) {
    device.reset(rtcNewDevice(nullptr));
    if (device == nullptr) fail(rtcGetDeviceError(nullptr));
    scene.reset(rtcNewScene(device.get()));
    // In robust mode a ray passes no box that it touches, so that no gap opens between pieces.
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);

    geometries.reserve(shapes.size());  // Embree keeps their addresses
    for (const auto& shape : shapes) {
      geometries.push_back({.shape = shape, .space = &space});
      const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryUserPrimitiveCount(geometry, shape->piece_count());
      rtcSetGeometryUserData(geometry, &geometries.back());
      rtcSetGeometryBoundsFunction(geometry, bound_piece, nullptr);
      rtcSetGeometryIntersectFunction(geometry, intersect_piece);
      rtcSetGeometryOccludedFunction(geometry, occlude_piece);
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(scene.get(), geometry, unsigned(geometries.size() - 1));
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene.get());
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
      fail(error);
  }

  RTCRay embree_ray(const Ray& ray, double t_max) const {
    const Vec3 o = space.from_world(ray.o);
    return {.org_x = o.x,
            .org_y = o.y,
            .org_z = o.z,
            .tnear = 0.0f,
            .dir_x = ray.d.x,
            .dir_y = ray.d.y,
            .dir_z = ray.d.z,
            .time = 0.0f,
            .tfar = space.from_world(t_max),
            .mask = ~0u,
            .id = 0,
            .flags = 0};
  }
};

RayQueries::RayQueries(std::span<const std::shared_ptr<const Shape>> shapes)
    : impl_(std::make_unique<const Impl>(shapes)) {
  assert(!shapes.empty());
}
RayQueries::RayQueries(RayQueries&&) noexcept = default;
RayQueries& RayQueries::operator=(RayQueries&&) noexcept = default;
RayQueries::~RayQueries() = default;

std::optional<Hit> RayQueries::intersect(const Ray& ray, float t_max) const {
  const auto start = impl_->space.near(ray);
  if (!start || !(start->t < t_max)) return std::nullopt;
  Query query(start->ray, t_max - start->t);
  RTCRayHit embree{};
  embree.ray = impl_->embree_ray(start->ray, query.t_max);
  embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene.get(), &query.context, &embree);
  if (!query.nearest) return std::nullopt;

  Hit hit = impl_->geometries[query.shape].shape->hit(query.ray, *query.nearest);
  // The distance to the surface itself, with a relative error of 2^-24: media integrate over it,
  // and the distance to the rounded point would be wrong by all of `hit.error`.
  hit.t =
      std::max(static_cast<float>(start->t + query.nearest->t), std::numeric_limits<float>::min());
  hit.shape = query.shape;
  return hit;
}

bool RayQueries::is_occluded(const Ray& ray, float t_max) const {
  const auto start = impl_->space.near(ray);
  if (!start || !(start->t < t_max)) return false;
  Query query(start->ray, t_max - start->t);
  RTCRay embree = impl_->embree_ray(start->ray, query.t_max);
  rtcOccluded1(impl_->scene.get(), &query.context, &embree);
  return embree.tfar < 0.0f;
}

}  // namespace brume
