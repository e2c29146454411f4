// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_path_set.h"

#include <algorithm>
#include <limits>

namespace brume {

void LightPathSet::add(const LightVertex& vertex, float p_kept) {
  const std::size_t lane = vertices_.size() % kLanes;
  if (lane == 0) blocks_.emplace_back();
  Rgb power = vertex.power;
  Vec3 axis = vertex.d;
  float g = vertex.phase.g;
  bool is_diffuse = false;
  if (vertex.hit) {
    const Hit& hit = *vertex.hit;
    const Bsdf& bsdf = scene_->bsdf(hit);
    power *= bsdf.albedo(hit.uv);
    if (bsdf.is_diffuse() && hit.n == hit.n_shading) {
      axis = glm::dot(vertex.d, hit.n) < 0.0f ? hit.n : -hit.n;
      is_diffuse = true;
    } else if (const auto lobe = bsdf.mirror_lobe()) {
      axis = glm::reflect(vertex.d, hit.n_shading);
      g = *lobe;
    } else {
      // Light leaves into few directions, or, by smooth normals, around corners.
      complex_.push_back(vertices_.size());
    }
  }
  Block& block = blocks_.back();
  block.x[lane] = vertex.p.x;
  block.y[lane] = vertex.p.y;
  block.z[lane] = vertex.p.z;
  block.axis_x[lane] = axis.x;
  block.axis_y[lane] = axis.y;
  block.axis_z[lane] = axis.z;
  block.g[lane] = g;
  block.is_diffuse[lane] = is_diffuse ? 1.0f : 0.0f;
  block.strength[lane] = luminance(power) / p_kept;
  vertices_.push_back(vertex);
  p_kept_.push_back(p_kept);
}

void LightPathSet::end_bundle() {
  vertices_.resize(blocks_.size() * kLanes);
  p_kept_.resize(blocks_.size() * kLanes, 1.0f);
  ends_.push_back(blocks_.size());
}

LightPathSet::Candidates LightPathSet::candidates_of(const Block& v, const Vec3& p) const {
  const Lanes x = reach_ * (v.x - p.x), y = reach_ * (v.y - p.y), z = reach_ * (v.z - p.z);
  const Lanes far = x * x + y * y + z * z;
  const Lanes inverse = 1.0f / sqrt(max(far, Lanes(std::numeric_limits<float>::min())));
  // Of the angle between the axis and the direction toward `p`.
  const Lanes cosine = -inverse * (x * v.axis_x + y * v.axis_y + z * v.axis_z);
  const Lanes in_lobe = henyey_greenstein(v.g, cosine);
  const Lanes diffuse = max(cosine, Lanes(0.0f)) / kPi;
  const Lanes leaving = in_lobe + v.is_diffuse * (diffuse - in_lobe);
  const Lanes tau = sigma_t_ / reach_ * far * inverse;
  const Lanes one_over_T = 1.0f + tau * (1.0f + tau * (0.5f + tau * (1.0f / 6.0f)));  // roughly
  return {.x = x * inverse,
          .y = y * inverse,
          .z = z * inverse,
          .far = far,
          .light = v.strength * leaving / one_over_T};
}

void LightPathSet::find_candidates(std::size_t begin, std::size_t end, const Vec3& p,
                                   int most_scatterings,
                                   std::vector<Candidates>& candidates) const {
  candidates.clear();
  for (std::size_t i = begin; i < end; ++i) candidates.push_back(candidates_of(blocks_[i], p));

  auto i = std::lower_bound(complex_.begin(), complex_.end(), begin * kLanes);
  for (; i != complex_.end() && *i < end * kLanes; ++i) {
    Candidates& c = candidates[*i / kLanes - begin];
    const std::size_t lane = *i % kLanes;
    const LightVertex& vertex = vertices_[*i];
    const Vec3 d(c.x[lane], c.y[lane], c.z[lane]);
    c.light[lane] = luminance(vertex.power * scattered_toward(*scene_, vertex, -d)) / p_kept_[*i];
  }
  if (most_scatterings == std::numeric_limits<int>::max()) return;
  for (std::size_t k = begin * kLanes; k < end * kLanes; ++k)
    if (vertices_[k].scatterings > most_scatterings)
      candidates[k / kLanes - begin].light[k % kLanes] = 0.0f;
}

}  // namespace brume
