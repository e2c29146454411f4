// SPDX-License-Identifier: Apache-2.0
#include "light/light_set.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace brume {

LightSet::LightSet(std::vector<std::shared_ptr<const Light>> lights,
                   std::vector<std::shared_ptr<const EnvironmentLight>> environments)
    : lights_(std::move(lights)), environments_(std::move(environments)) {}

std::optional<LightSample> LightSet::sample(const Vec3& p, float u_choice, const Vec2& u) const {
  if (size() == 0) return std::nullopt;
  const std::size_t chosen = std::min(std::size_t(u_choice * float(size())), size() - 1);
  const float p_chosen = probability(p, chosen);

  if (chosen < lights_.size()) {
    std::optional<LightSample> s = lights_[chosen]->sample(p, u);
    if (s) {
      s->weight /= p_chosen;
      s->pdf *= p_chosen;
    }
    return s;
  }

  std::optional<LightSample> s = environments_[chosen - lights_.size()]->sample(p, u);
  if (!s) return std::nullopt;
  // What the chosen one contributes is taken from its sample, not looked up again: rounding may
  // put a direction sampled at the edge of a disk outside it.
  Rgb L = s->weight * s->pdf;
  float pdf = p_chosen * s->pdf;
  for (std::size_t i = 0; i < environments_.size(); ++i) {
    if (lights_.size() + i == chosen) continue;
    L += environments_[i]->radiance(s->d);
    pdf += probability(p, lights_.size() + i) * environments_[i]->pdf(s->d);
  }
  s->weight = L / pdf;
  s->pdf = pdf;
  return s;
}

float LightSet::probability(const Vec3& /*p*/, [[maybe_unused]] std::size_t index) const {
  assert(index < size());
  return 1.0f / float(size());
}

Rgb LightSet::environment_radiance(const Vec3& d) const {
  Rgb L{0.0f};
  for (const auto& environment : environments_) L += environment->radiance(d);
  return L;
}

float LightSet::environment_pdf(const Vec3& from, const Vec3& d) const {
  float pdf = 0.0f;
  for (std::size_t i = 0; i < environments_.size(); ++i)
    pdf += probability(from, lights_.size() + i) * environments_[i]->pdf(d);
  return pdf;
}

}  // namespace brume
