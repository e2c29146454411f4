// SPDX-License-Identifier: Apache-2.0
#include "scene/contradiction.h"

#include <algorithm>

#include "core/frame.h"
#include "core/warp.h"

namespace brume {
namespace {

/// Paths that begin at each boundary, fewer where there are many, and where they end.
constexpr std::size_t kMostPaths = 8192, kPathsPerBoundary = 64;
constexpr int kMostSurfaces = 6;
/// Segments between boundaries of which one may contradict by rounding.
constexpr std::size_t kSegmentsPerStray = 1000;

struct Findings {
  std::size_t segments = 0, contradictions = 0;
  std::optional<Contradiction> first;
};

/// Follows light along `ray` from surface to surface, as if media did not scatter. Between two
/// boundaries that it crosses it may be reflected.
void follow(const Scene& scene, Ray ray, Rng& rng, Findings& findings) {
  std::optional<std::uint32_t> from;  // the latest boundary that it crossed
  const Medium* medium = nullptr;     // behind it
  for (int surface = 0; surface < kMostSurfaces; ++surface) {
    const auto hit = scene.intersect(ray, kInfinity);
    if (!hit) return;
    const Frame frame(hit->n_shading, hit->dp_du);
    const float u_lobe = rng.next_float();
    const auto next =
        scene.bsdf(*hit).sample(frame.to_local(-ray.d), hit->uv, u_lobe, rng.next_vec2());
    if (!next) return;
    const Vec3 d = next->straight ? ray.d : frame.to_world(next->wi);
    const bool crosses = glm::dot(ray.d, hit->n) * glm::dot(d, hit->n) > 0.0f;
    if (crosses && scene.is_boundary(*hit)) {
      const Medium* met = scene.medium_across(*hit, -ray.d, nullptr);
      if (from) {
        ++findings.segments;
        findings.contradictions += met != medium ? 1 : 0;
        if (met != medium && !findings.first)
          findings.first = {.from = *from, .to = hit->shape, .left = medium, .met = met};
      }
      from = hit->shape;
      medium = scene.medium_across(*hit, d, nullptr);
    }
    ray = hit->leave(d);
  }
}

}  // namespace

std::optional<Contradiction> find_contradiction(const Scene& scene) {
  std::vector<const Shape*> boundaries;
  for (const Surface& surface : scene.surfaces())
    if (surface.is_boundary) boundaries.push_back(surface.shape.get());
  if (boundaries.size() < 2) return std::nullopt;

  Findings findings;
  Rng rng(boundaries.size());
  const std::size_t paths =
      std::clamp<std::size_t>(kMostPaths / boundaries.size(), 1, kPathsPerBoundary);
  for (const Shape* shape : boundaries)
    for (std::size_t i = 0; i < paths; ++i) {
      const SurfacePoint point = shape->sample_area(rng.next_vec2());
      const Vec3 d = sample_uniform_sphere(rng.next_vec2());
      follow(scene, {.o = point.leave(-d).o, .d = d}, rng, findings);
    }
  const bool is_more_than_rounding =
      findings.contradictions > 1 + findings.segments / kSegmentsPerStray;
  return is_more_than_rounding ? findings.first : std::nullopt;
}

}  // namespace brume
