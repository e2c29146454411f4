// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <experimental/simd>
#include <optional>
#include <vector>

#include "integrator/light_tracer.h"

namespace brume {

/// Places where light scatters, in bundles of light paths, and the choice of one that a path from
/// the camera is connected to.
class LightPathSet {
 public:
  /// As many places are looked at together.
  using Lanes = std::experimental::fixed_size_simd<float, 8>;

  /// Phase function of Henyey and Greenstein, roughly where it is steepest [1/sr].
  static Lanes henyey_greenstein(const Lanes& g, const Lanes& cosine);

  /// `reach` [1/unit] and `sigma_t` [1/unit] as in LightPaths and LightPathGuide.
  LightPathSet(const Scene& scene, float reach, float sigma_t, int paths_per_bundle)
      : scene_(&scene), reach_(reach), sigma_t_(sigma_t), paths_per_bundle_(paths_per_bundle) {}

  /// To the bundle that is being filled; `p_kept` is the probability that the vertex is added.
  void add(const LightVertex& vertex, float p_kept);
  void end_bundle();

  /// What a place scatters toward the camera from a direction.
  struct Seen {
    Lanes value;  // roughly, in luminance, the cosine at a surface included [1/sr]
    Lanes pdf;    // roughly, with which the camera's path goes on into the direction [1/sr]
  };
  struct Choice {
    const LightVertex* vertex;
    float weight;  // one over the times that a light path brings the vertex and it is chosen
  };
  /// Chooses from a bundle by the light that a place `p` would scatter toward the camera if nothing
  /// stood in between (resampled importance sampling, Talbot et al. 2005). `seen(x, y, z)` returns
  /// `Seen` for unit directions. Light has scattered `most_scatterings` times at most. Nothing
  /// where none could arrive.
  template <class SeenFrom>
  std::optional<Choice> choose(std::uint32_t bundle, const Vec3& p, int most_scatterings,
                               const SeenFrom& seen, float u) const;

 private:
  static constexpr std::size_t kLanes = Lanes::size();

  /// What a guess of the light needs of the vertices.
  struct Block {
    Lanes x{0.0f}, y{0.0f}, z{0.0f};                 // [unit]
    Lanes axis_x{0.0f}, axis_y{0.0f}, axis_z{0.0f};  // that light leaves around
    Lanes g{0.0f};
    Lanes is_diffuse{0.0f};  // 1 where Lambert's law takes the place of Henyey and Greenstein's
    Lanes strength{0.0f};    // of what leaves, in luminance, over `p_kept` [W]; 0: no vertex
  };
  /// What a place would get from vertices if nothing stood in between.
  struct Candidates {
    Lanes x, y, z;  // unit direction toward them
    Lanes far;      // reach times distance, squared
    Lanes light;    // roughly that leaves them toward the place, in luminance
  };
  void find_candidates(std::size_t begin, std::size_t end, const Vec3& p, int most_scatterings,
                       std::vector<Candidates>& candidates) const;
  Candidates candidates_of(const Block& block, const Vec3& p) const;

  const Scene* scene_;
  float reach_, sigma_t_;
  int paths_per_bundle_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> ends_;      // [bundle], in blocks_
  std::vector<LightVertex> vertices_;  // [block][lane]
  std::vector<float> p_kept_;          // [block][lane]
  std::vector<std::size_t> complex_;   // vertices that no block can describe, in their order
};

inline LightPathSet::Lanes LightPathSet::henyey_greenstein(const Lanes& g, const Lanes& cosine) {
  const Lanes denominator = max(1.0f + g * (g - 2.0f * cosine), Lanes(1e-6f));
  return (1.0f - g * g) / (4.0f * kPi * denominator * sqrt(denominator));
}

template <class SeenFrom>
std::optional<LightPathSet::Choice> LightPathSet::choose(std::uint32_t bundle, const Vec3& p,
                                                         int most_scatterings, const SeenFrom& seen,
                                                         float u) const {
  thread_local std::vector<Candidates> candidates;
  const std::size_t begin = bundle == 0 ? 0 : ends_[bundle - 1];
  find_candidates(begin, ends_[bundle], p, most_scatterings, candidates);
  double total = 0.0;
  for (Candidates& c : candidates) {
    const Seen s = seen(c.x, c.y, c.z);
    c.light *= s.value / (c.far + s.pdf);
    where(!(c.light > 0.0f), c.light) = 0.0f;
    total += reduce(c.light);
  }
  if (!(total > 0.0 && total < kInfinity)) return std::nullopt;

  // First the block, then what is left of the random number chooses within it.
  double rest = u * total;
  std::size_t block = 0;
  while (block + 1 < candidates.size() && rest >= reduce(candidates[block].light))
    rest -= reduce(candidates[block++].light);
  const Lanes& light = candidates[block].light;
  const float of_block = reduce(light);
  double running = 0.0, sum = 0.0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) sum += light[lane];
  rest = std::min(rest / of_block, double(kOneMinusEpsilon)) * sum;
  std::size_t lane = 0;
  while (lane + 1 < kLanes && rest >= (running += light[lane])) ++lane;
  if (!(light[lane] > 0.0f)) return std::nullopt;
  const std::size_t chosen = (begin + block) * kLanes + lane;
  return Choice{
      .vertex = &vertices_[chosen],
      .weight = float(total / (double(light[lane]) * p_kept_[chosen])) / float(paths_per_bundle_)};
}

}  // namespace brume
