// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_paths.h"

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "scene/contradiction.h"

namespace brume {
namespace {

constexpr int kReceivers = 1024;
/// Places in a bundle that are aimed at, and the light paths that it has at most for that.
constexpr float kPlacesPerBundle = 64.0f;
constexpr int kMostPathsPerBundle = 512;
/// Light paths are worth it where they would bring at least this share of the light, judged by the
/// distances that light travels between two scatterings.
constexpr float kLeastShare = 0.5f;

}  // namespace

LightPaths::LightPaths(const Scene& scene, const Camera& camera, const CameraMedium& camera_medium,
                       int max_scatterings)
    : scene_(scene), tracer_(scene, max_scatterings) {
  if (tracer_.lamps().empty() || find_contradiction(scene)) return;
  guide_.emplace(scene, tracer_, find_receivers(scene, camera, camera_medium, kReceivers));
  if (!guide_->found_light() || guide_->distances().empty()) return;
  const float per_path = guide_->kept_per_path();
  const auto paths =
      int(std::clamp(kPlacesPerBundle / per_path + 0.5f, 1.0f, float(kMostPathsPerBundle)));
  p_kept_ = std::min(kPlacesPerBundle / (per_path * float(paths)), 1.0f);
  const float places = p_kept_ * per_path * float(paths);

  // Rays between places in a box are 4 volume / area long on average: a path with as many flights
  // as places brings a fluence of 4 / area of its power. A quarter of that is what is in sight and
  // not worth less than others.
  const Vec3 size = guide_->bounds().size();
  const float area = 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);
  reach_ = std::sqrt(places / area);
  if (!std::isfinite(reach_squared()) || !(reach_squared() > 0.0f)) return;
  float share = 0.0f;
  for (const float distance : guide_->distances())
    share += (1.0f - camera_share(distance, 0.25f / kPi)) / float(guide_->distances().size());
  if (share > kLeastShare) paths_per_bundle_ = paths;
}

std::shared_ptr<const LightPathSet> LightPaths::of(const Key& shared) const {
  Slot& slot = slots_[shared.group % kGroups];
  const std::lock_guard lock(slot.mutex);
  const std::uint64_t own_seed = hash_combine(shared.seed, shared.group);
  if (slot.set == nullptr || slot.seed != own_seed) {
    slot.set = traced(own_seed);
    slot.seed = own_seed;
  }
  return slot.set;
}

std::shared_ptr<const LightPathSet> LightPaths::traced(std::uint64_t seed) const {
  auto set = std::make_shared<LightPathSet>(scene_, reach_, guide_->sigma_t(), paths_per_bundle_);
  std::vector<LightVertex> vertices;
  for (std::uint32_t bundle = 0; bundle < Sampler::kBlock; ++bundle) {
    vertices.clear();
    for (int i = 0; i < paths_per_bundle_; ++i) {
      Sampler sampler(seed, bundle, std::uint32_t(i));
      const LightPathGuide::Start start = guide_->start(sampler);
      tracer_.trace(tracer_.lamps()[start.lamp], start.u_direction, start.weight, sampler,
                    vertices);
    }
    Rng rng(seed, bundle);
    for (const LightVertex& vertex : vertices) {
      const float p_kept = p_kept_ * guide_->keep(vertex);
      if (rng.next_float() < p_kept) set->add(vertex, p_kept);
    }
    set->end_bundle();
  }
  return set;
}

}  // namespace brume
