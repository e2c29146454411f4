// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_path_set.h"

#include <algorithm>
#include <cmath>

namespace brume {

void LightPathSet::add(const LightVertex& vertex, float p_kept) {
  Rgb power = vertex.power;
  Vec3 axis = vertex.d;
  if (vertex.hit) {
    const Hit& hit = *vertex.hit;
    axis = glm::dot(vertex.d, hit.n) < 0.0f ? hit.n : -hit.n;
    if (scene_->bsdf(hit).is_diffuse())
      power *= scene_->bsdf(hit).albedo(hit.uv);
    else
      glossy_.push_back(vertices_.size());
  }
  vertices_.push_back(vertex);
  p_kept_.push_back(p_kept);
  x_.push_back(vertex.p.x);
  y_.push_back(vertex.p.y);
  z_.push_back(vertex.p.z);
  axis_x_.push_back(axis.x);
  axis_y_.push_back(axis.y);
  axis_z_.push_back(axis.z);
  g_.push_back(vertex.phase.g);
  is_surface_.push_back(vertex.hit ? 1.0f : 0.0f);
  strength_.push_back(luminance(power) / p_kept);
}

void LightPathSet::find_candidates(std::uint32_t bundle, const Vec3& p, int most_scatterings,
                                   Candidates& candidates) const {
  const std::size_t begin = bundle == 0 ? 0 : ends_[bundle - 1], end = ends_[bundle];
  const std::size_t count = end - begin;
  candidates.begin = begin;
  for (std::vector<float>* column :
       {&candidates.x, &candidates.y, &candidates.z, &candidates.far, &candidates.light})
    column->resize(count);

  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t v = begin + i;
    const float x = reach_ * (x_[v] - p.x), y = reach_ * (y_[v] - p.y), z = reach_ * (z_[v] - p.z);
    const float far = x * x + y * y + z * z;
    const float inverse = 1.0f / std::sqrt(std::max(far, std::numeric_limits<float>::min()));
    candidates.x[i] = x * inverse;
    candidates.y[i] = y * inverse;
    candidates.z[i] = z * inverse;
    candidates.far[i] = far;
    // Of the angle between the axis and the direction toward `p`.
    const float cosine = -inverse * (x * axis_x_[v] + y * axis_y_[v] + z * axis_z_[v]);
    const float g = g_[v], denominator = std::max(1.0f + g * (g - 2.0f * cosine), 1e-6f);
    const float phase = 0.25f * (1.0f - g * g) / (denominator * std::sqrt(denominator));
    const float reflected = std::max(cosine, 0.0f);
    const float leaving = (phase + is_surface_[v] * (reflected - phase)) * (1.0f / kPi);
    // exp(-tau), roughly.
    const float tau = sigma_t_ / reach_ * far * inverse;
    const float T = 1.0f / (1.0f + tau * (1.0f + tau * (0.5f + tau * (1.0f / 6.0f))));
    candidates.light[i] = strength_[v] * leaving * T;
  }

  // Glossy surfaces send their light into few directions.
  auto glossy = std::lower_bound(glossy_.begin(), glossy_.end(), begin);
  for (; glossy != glossy_.end() && *glossy < end; ++glossy) {
    const std::size_t i = *glossy - begin;
    const LightVertex& vertex = vertices_[*glossy];
    const Vec3 d(candidates.x[i], candidates.y[i], candidates.z[i]);
    candidates.light[i] =
        luminance(vertex.power * scattered_toward(*scene_, vertex, -d)) / p_kept_[*glossy];
  }
  if (most_scatterings == std::numeric_limits<int>::max()) return;
  for (std::size_t i = 0; i < count; ++i)
    if (vertices_[begin + i].scatterings > most_scatterings) candidates.light[i] = 0.0f;
}

}  // namespace brume
