// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace brume {
namespace {

/// Where no medium is declared, the one that fills space stands outside; a closed shape keeps it
/// out of its inside.
void place_in_world(Surface& surface, const std::shared_ptr<const Medium>& world_medium) {
  if (world_medium == nullptr) return;
  if (surface.shape->is_closed()) surface.is_boundary = true;
  if (surface.is_boundary && surface.exterior == nullptr) surface.exterior = world_medium;
}

/// Of surfaces at the same place the first is met: a light before the wall that it is mounted on,
/// the wall before the boundary of the fog that it holds back.
std::vector<Surface> with_invisible_last(std::vector<Surface> surfaces) {
  const auto is_visible = [](const Surface& s) {
    return s.radiance ||
           s.bsdf->straight_transmittance(Vec3(0.0f, 0.0f, 1.0f), Vec2(0.5f)) != Rgb(1.0f);
  };
  const auto invisible = std::stable_partition(surfaces.begin(), surfaces.end(), is_visible);
  std::stable_partition(surfaces.begin(), invisible,
                        [](const Surface& s) { return s.radiance.has_value(); });
  return surfaces;
}

/// Media that surfaces hold together: none of them lies outside a surface or inside an open one.
std::vector<const Medium*> enclosed_media(const std::vector<Surface>& surfaces,
                                          const Medium* world_medium) {
  std::vector<const Medium*> enclosed;
  for (const Surface& candidate : surfaces) {
    const Medium* medium = candidate.interior.get();
    if (!candidate.is_boundary || medium == nullptr || medium == world_medium) continue;
    const bool reaches_out = std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) {
      return s.is_boundary &&
             (s.exterior.get() == medium || (s.interior.get() == medium && !s.shape->is_closed()));
    });
    if (!reaches_out) enclosed.push_back(medium);
  }
  return enclosed;
}

std::vector<std::shared_ptr<const Shape>> shapes_of(const std::vector<Surface>& surfaces) {
  std::vector<std::shared_ptr<const Shape>> shapes;
  for (const Surface& surface : surfaces) shapes.push_back(surface.shape);
  return shapes;
}

std::vector<bool> which_pass_straight(const std::vector<Surface>& surfaces) {
  std::vector<bool> result;
  for (const Surface& surface : surfaces) result.push_back(surface.bsdf->passes_straight());
  return result;
}

/// Lights of all surfaces, which come first in the set of lights, then the others.
std::vector<std::shared_ptr<const Light>> joined(
    const std::vector<std::shared_ptr<const AreaLight>>& area_lights,
    const std::vector<std::shared_ptr<const Light>>& others) {
  std::vector<std::shared_ptr<const Light>> lights;
  for (const auto& light : area_lights)
    if (light) lights.push_back(light);
  lights.insert(lights.end(), others.begin(), others.end());
  return lights;
}

std::vector<std::shared_ptr<const AreaLight>> area_lights_of(const std::vector<Surface>& surfaces) {
  std::vector<std::shared_ptr<const AreaLight>> lights;
  for (const Surface& surface : surfaces)
    lights.push_back(surface.radiance && !is_black(*surface.radiance)
                         ? std::make_shared<const AreaLight>(surface.shape, *surface.radiance)
                         : nullptr);
  return lights;
}

}  // namespace

Scene::Scene(SceneParts parts)
    : requirements_(requirements_of(parts)),
      surfaces_(with_invisible_last(std::move(parts.surfaces))),
      world_medium_(std::move(parts.world_medium)),
      area_lights_(area_lights_of(surfaces_)),
      lights_(joined(area_lights_, parts.lights), std::move(parts.environments)) {
  for (Surface& surface : surfaces_) place_in_world(surface, world_medium_);
  enclosed_ = enclosed_media(surfaces_, world_medium_.get());
  const std::vector<bool> passes_straight = which_pass_straight(surfaces_);
  has_opaque_ = std::count(passes_straight.begin(), passes_straight.end(), false) > 0;
  if (!surfaces_.empty()) queries_.emplace(shapes_of(surfaces_), passes_straight);

  std::size_t index = 0;
  for (const auto& light : area_lights_) light_index_.push_back(light ? index++ : 0);
}

std::optional<Hit> Scene::intersect(const Ray& ray, float t_max) const {
  return queries_ ? queries_->intersect(ray, t_max) : std::nullopt;
}

const Medium* Scene::medium_across(const Hit& hit, const Vec3& d, const Medium* medium) const {
  const bool enters = glm::dot(d, hit.n) < 0.0f;
  const auto behind = [&](const Surface& surface, bool enters_it) {
    if (!surface.is_boundary) return medium;
    return (enters_it ? surface.interior : surface.exterior).get();
  };
  const Medium* result = behind(surfaces_[hit.shape], enters);
  bool is_entered = enters && surfaces_[hit.shape].is_boundary;
  for (std::uint32_t i = 0; i < hit.coincident_count && !is_entered; ++i) {
    const Surface& surface = surfaces_[hit.coincident[i].shape];
    if (!surface.is_boundary) continue;
    is_entered = hit.coincident[i].faces_alike == enters;
    result = behind(surface, is_entered);
  }
  return result;
}

bool Scene::is_boundary(const Hit& hit) const {
  const auto begin = hit.coincident.begin();
  return surfaces_[hit.shape].is_boundary ||
         std::any_of(begin, begin + hit.coincident_count,
                     [&](const Hit::Coincident& c) { return surfaces_[c.shape].is_boundary; });
}

Scene::MediumAt Scene::medium_at(const Vec3& p) const {
  // Rays aimed at every boundary: the first boundary that each meets says what is on this side.
  struct Vote {
    const Medium* medium;
    int count;
  };
  std::vector<Vote> votes;
  constexpr int kRaysPerBoundary = 16;
  for (const Surface& target : surfaces_) {
    if (!target.is_boundary) continue;
    for (int i = 0; i < kRaysPerBoundary; ++i) {
      const Vec2 u((float(i) + 0.5f) / kRaysPerBoundary,
                   std::fmod(0.5f + float(i) * 0.618034f, 1.0f));
      const auto aim = target.shape->sample_toward(p, u);
      if (!aim || aim->p == p) continue;
      Ray ray{.o = p, .d = glm::normalize(aim->p - p)};
      auto hit = intersect(ray, kInfinity);
      while (hit && !is_boundary(*hit)) {
        ray = hit->leave(ray.d);
        hit = intersect(ray, kInfinity);
      }
      if (!hit) continue;
      const Medium* medium = medium_across(*hit, -ray.d, nullptr);
      const auto same = std::find_if(votes.begin(), votes.end(),
                                     [&](const Vote& v) { return v.medium == medium; });
      if (same == votes.end())
        votes.push_back({medium, 1});
      else
        ++same->count;
    }
  }
  if (votes.empty()) return {world_medium_.get(), true};
  const auto most = std::max_element(
      votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.count < b.count; });
  return {most->medium, votes.size() == 1};
}

const Medium* Scene::medium_to_infinity(const Medium* medium) const {
  const bool ends = std::find(enclosed_.begin(), enclosed_.end(), medium) != enclosed_.end();
  return ends ? world_medium_.get() : medium;
}

const Medium* Scene::medium_beside(const Vec3& from, const Medium* medium, const Vec3& to) const {
  if (from == to) return medium;
  Ray ray{.o = from, .d = glm::normalize(to - from)};
  float distance = glm::distance(from, to);
  while (const auto hit = intersect(ray, distance)) {
    medium = medium_across(*hit, ray.d, medium);
    distance -= hit->t;
    ray = hit->leave_toward(ray.d, distance);
  }
  return medium;
}

Rgb Scene::transmittance(const Ray& ray, float distance, const Medium* medium, Rng& rng,
                         bool similar) const {
  const auto crossing = [&](const Ray& part, float length) {
    return (similar ? medium->similar() : *medium).transmittance(part, length, rng);
  };
  // Most light meets a wall or nothing. That is cheaper to ask than what it meets first, unless
  // nothing is opaque.
  Obstacle obstacle = queries_ ? Obstacle::kPassable : Obstacle::kNone;
  if (has_opaque_) obstacle = queries_->obstacle(ray, distance);
  if (obstacle == Obstacle::kOpaque) return Rgb{0.0f};
  if (obstacle == Obstacle::kNone) {
    if (!(distance < kInfinity)) medium = medium_to_infinity(medium);
    return medium == nullptr ? Rgb{1.0f} : crossing(ray, distance);
  }

  Rgb T{1.0f};
  Ray segment = ray;
  while (true) {
    const auto hit = intersect(segment, distance);
    Rgb passing{1.0f};
    if (hit) {
      const Frame frame(hit->n_shading, hit->dp_du);
      passing = bsdf(*hit).straight_transmittance(frame.to_local(-segment.d), hit->uv);
      if (is_black(passing)) return passing;
    }
    if (!hit && !(distance < kInfinity)) medium = medium_to_infinity(medium);
    if (medium != nullptr) T *= crossing(segment, hit ? hit->t : distance);
    if (!hit || is_black(T)) return T;
    T *= passing;
    medium = medium_across(*hit, segment.d, medium);
    distance -= hit->t;
    segment = hit->leave_toward(segment.d, distance);
  }
}

std::optional<Scene::Emission> Scene::emission(const Vec3& from, const Hit& hit,
                                               const Vec3& d) const {
  const auto& light = area_lights_[hit.shape];
  if (light == nullptr) return std::nullopt;
  const Rgb L = light->radiance(hit, d);
  if (is_black(L)) return std::nullopt;
  return Emission{.L = L, .light = light_index_[hit.shape], .pdf = light->pdf(from, hit)};
}

}  // namespace brume
