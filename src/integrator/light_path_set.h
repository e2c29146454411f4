// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "integrator/light_tracer.h"

namespace brume {

/// Places where light scatters, in bundles of light paths, and the choice of one that a path from
/// the camera is connected to.
class LightPathSet {
 public:
  /// `reach` [1/unit] and `sigma_t` [1/unit] as in LightPaths and LightPathGuide.
  LightPathSet(const Scene& scene, float reach, float sigma_t, int paths_per_bundle)
      : scene_(&scene), reach_(reach), sigma_t_(sigma_t), paths_per_bundle_(paths_per_bundle) {}

  /// To the bundle that is being filled; `p_kept` is the probability that the vertex is added.
  void add(const LightVertex& vertex, float p_kept);
  void end_bundle() { ends_.push_back(vertices_.size()); }

  /// What a place scatters toward the camera from a direction.
  struct Seen {
    float value;  // in luminance, the cosine at a surface included [1/sr]
    float pdf;    // with which the camera's path goes on into the direction [1/sr]
  };
  struct Choice {
    const LightVertex* vertex;
    float weight;  // one over the times that a light path brings the vertex and it is chosen
  };
  /// Chooses from a bundle by the light that a place `p` would scatter toward the camera if nothing
  /// stood in between (resampled importance sampling, Talbot et al. 2005). `seen(x, y, z)` returns
  /// `Seen` for a unit direction. Light has scattered `most_scatterings` times at most. Nothing
  /// where none could arrive.
  template <class SeenFrom>
  std::optional<Choice> choose(std::uint32_t bundle, const Vec3& p, int most_scatterings,
                               const SeenFrom& seen, float u) const;

 private:
  /// What a place would get from each vertex of a bundle if nothing stood in between.
  struct Candidates {
    std::size_t begin = 0;       // the first vertex
    std::vector<float> x, y, z;  // unit direction toward it
    std::vector<float> far;      // reach times distance, squared
    std::vector<float> light;    // roughly that leaves it toward the place, in luminance
  };
  void find_candidates(std::uint32_t bundle, const Vec3& p, int most_scatterings,
                       Candidates& candidates) const;

  const Scene* scene_;
  float reach_, sigma_t_;
  int paths_per_bundle_;
  std::vector<LightVertex> vertices_;
  std::vector<std::size_t> ends_;    // [bundle], in vertices_
  std::vector<float> p_kept_;        // [vertex]
  std::vector<std::size_t> glossy_;  // vertices on surfaces that are not diffuse, in their order
  // What a guess of the light needs, [vertex]:
  std::vector<float> x_, y_, z_;                 // [unit]
  std::vector<float> axis_x_, axis_y_, axis_z_;  // along the light; on surfaces the normal there
  std::vector<float> g_;                         // 0 on surfaces
  std::vector<float> is_surface_;                // 1 or 0
  std::vector<float> strength_;                  // of what leaves, in luminance, over p_kept [W]
};

template <class SeenFrom>
std::optional<LightPathSet::Choice> LightPathSet::choose(std::uint32_t bundle, const Vec3& p,
                                                         int most_scatterings, const SeenFrom& seen,
                                                         float u) const {
  thread_local Candidates candidates;
  find_candidates(bundle, p, most_scatterings, candidates);
  std::vector<float>& light = candidates.light;
  float total = 0.0f;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Seen s = seen(candidates.x[i], candidates.y[i], candidates.z[i]);
    const float value = light[i] * s.value / (candidates.far[i] + s.pdf);
    light[i] = value > 0.0f && value < kInfinity ? value : 0.0f;
    total += light[i];
  }
  if (!(total > 0.0f && total < kInfinity)) return std::nullopt;
  float rest = u * total;
  std::size_t chosen = light.size();
  for (std::size_t i = 0; i < light.size() && rest >= 0.0f; ++i) {
    if (light[i] == 0.0f) continue;
    chosen = i;
    rest -= light[i];
  }
  const std::size_t vertex = candidates.begin + chosen;
  return Choice{.vertex = &vertices_[vertex],
                .weight = total / (light[chosen] * p_kept_[vertex] * float(paths_per_bundle_))};
}

}  // namespace brume
