// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray_queries.h"

#include <cassert>
#include <utility>
#include <vector>

namespace brume {
namespace {

/// Largest double below the exclusive limit `t_max`.
double inclusive(float t_max) {
  return std::nextafter(double(t_max), 0.0);
}

PreciseRay precise(const Ray& ray) {
  return {.o = Vec3d(ray.o), .d = Vec3d(ray.d)};
}

}  // namespace

class RayQueries::Impl final : public Hierarchy::Items {
 public:
  Impl(std::span<const std::shared_ptr<const Shape>> shapes, std::vector<bool> is_passable)
      : shapes_(shapes.begin(), shapes.end()),
        is_passable_(std::move(is_passable)),
        hierarchy_(*this, Hierarchy::Behind::kFind) {
    is_passable_.resize(shapes_.size());
  }

  std::uint32_t count() const override { return static_cast<std::uint32_t>(shapes_.size()); }
  Box3 bounds(std::uint32_t item) const override { return shapes_[item]->bounds(); }
  std::optional<Crossing> intersect(std::uint32_t item, const PreciseRay& ray,
                                    double t_max) const override {
    return shapes_[item]->intersect(ray, t_max);
  }
  Obstacle obstacle(std::uint32_t item, const PreciseRay& ray, double t_max) const override {
    if (!shapes_[item]->occludes(ray, t_max)) return Obstacle::kNone;
    return is_passable_[item] ? Obstacle::kPassable : Obstacle::kOpaque;
  }

  Hit hit(const Hierarchy::Found& found, const Hierarchy::ItemCrossing& at) const {
    Hit hit = shapes_[at.item]->hit(found.ray, at.crossing);
    // The distance to the surface itself, with a relative error of 2^-24: media integrate over it,
    // and the distance to the rounded point would be wrong by all of `hit.error`.
    hit.t = std::max(static_cast<float>(found.start + at.crossing.t),
                     std::numeric_limits<float>::min());
    hit.shape = at.item;
    return hit;
  }

  /// Of the crossings that a ray leaving `nearest` leaves behind, that of the first shape.
  Hit first_of_coincident(const Hierarchy::Found& found, const Hit& nearest) const {
    const double cosine = std::abs(glm::dot(found.ray.d, Vec3d(nearest.n)));
    const double step = 2.0 * rounding_error(nearest.p, nearest.n, nearest.error);
    const auto is_left_behind = [&](const Hierarchy::ItemCrossing& at) {
      return (at.crossing.t - found.crossings.nearest().crossing.t) * cosine <= step;
    };
    const Hierarchy::ItemCrossing* first = found.crossings.begin();
    for (const Hierarchy::ItemCrossing& at : found.crossings)
      if (is_left_behind(at) && at.item < first->item) first = &at;

    Hit result = hit(found, *first);
    for (const Hierarchy::ItemCrossing& at : found.crossings) {
      if (&at == first || !is_left_behind(at)) continue;
      const Vec3 n = shapes_[at.item]->hit(found.ray, at.crossing).n;
      result.coincident[result.coincident_count++] = {.shape = at.item,
                                                      .faces_alike = glm::dot(n, result.n) > 0.0f};
    }
    return result;
  }

  const Hierarchy& hierarchy() const { return hierarchy_; }

 private:
  std::vector<std::shared_ptr<const Shape>> shapes_;
  std::vector<bool> is_passable_;  // [shape]
  Hierarchy hierarchy_;
};

RayQueries::RayQueries(std::span<const std::shared_ptr<const Shape>> shapes,
                       std::vector<bool> is_passable) {
  assert(!shapes.empty());
  impl_ = std::make_unique<const Impl>(shapes, std::move(is_passable));
}
RayQueries::RayQueries(RayQueries&&) noexcept = default;
RayQueries& RayQueries::operator=(RayQueries&&) noexcept = default;
RayQueries::~RayQueries() = default;

std::optional<Hit> RayQueries::intersect(const Ray& ray, float t_max) const {
  const auto found = impl_->hierarchy().nearest(precise(ray), inclusive(t_max));
  if (!found) return std::nullopt;
  std::optional<Hit> hit(impl_->hit(*found, found->crossings.nearest()));
  const bool is_alone = found->crossings.begin() + 1 == found->crossings.end();
  if (!is_alone) *hit = impl_->first_of_coincident(*found, *hit);
  return hit;
}

Obstacle RayQueries::obstacle(const Ray& ray, float t_max) const {
  return impl_->hierarchy().obstacle(precise(ray), inclusive(t_max));
}

}  // namespace brume
