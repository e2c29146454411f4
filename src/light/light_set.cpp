// SPDX-License-Identifier: Apache-2.0
#include "light/light_set.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace brume {
namespace {

/// Part of the choices among lights that does not look at their importance.
constexpr float kUniformPart = 0.2f;

}  // namespace

LightSet::LightSet(std::vector<std::shared_ptr<const Light>> lights,
                   std::vector<std::shared_ptr<const EnvironmentLight>> environments)
    : lights_(std::move(lights)), environments_(std::move(environments)) {
  far_importance_.resize(size(), 0.0f);
  for (std::size_t i = 0; i < size(); ++i) {
    if (has_pivot(i)) {
      with_pivot_.push_back(i);
      continue;
    }
    far_importance_[i] = i < lights_.size()
                             ? lights_[i]->importance(Vec3(0.0f))
                             : environments_[i - lights_.size()]->importance(Vec3(0.0f));
    importance_without_pivot_ += far_importance_[i];
  }
  for (std::size_t i = 0; i < size(); ++i)
    if (i < lights_.size() || far_importance_[i] > 0.0f) choices_.push_back(i);
}

bool LightSet::may_choose(std::size_t index) const {
  return std::binary_search(choices_.begin(), choices_.end(), index);
}

float LightSet::importance(const Vec3& p, std::size_t index) const {
  // Only lights that are somewhere look different from elsewhere.
  return far_importance_[index] > 0.0f || index >= lights_.size() ? far_importance_[index]
                                                                  : lights_[index]->importance(p);
}

float LightSet::total_importance(const Vec3& p) const {
  float total = importance_without_pivot_;
  for (const std::size_t i : with_pivot_) total += lights_[i]->importance(p);
  return total;
}

float LightSet::probability(float importance, float total) const {
  const float uniform = 1.0f / float(choices_.size());
  return total > 0.0f ? kUniformPart * uniform + (1.0f - kUniformPart) * (importance / total)
                      : uniform;
}

float LightSet::probability(const Vec3& p, std::size_t index) const {
  assert(index < size());
  if (!may_choose(index)) return 0.0f;
  if (choices_.size() == 1) return 1.0f;
  return probability(importance(p, index), total_importance(p));
}

std::optional<LightSet::Arrival> LightSet::sample(const Vec3& p, float u_choice,
                                                  const Vec2& u) const {
  if (choices_.empty()) return std::nullopt;
  std::size_t chosen = choices_.front();
  float p_chosen = 1.0f;
  float total = 0.0f;
  if (choices_.size() > 1) {
    total = total_importance(p);
    float remaining = u_choice;
    for (const std::size_t i : choices_) {
      chosen = i;
      p_chosen = probability(importance(p, i), total);
      remaining -= p_chosen;
      if (remaining < 0.0f) break;
    }
  }

  if (chosen < lights_.size()) {
    const std::optional<LightSample> s = lights_[chosen]->sample(p, u);
    if (!s) return std::nullopt;
    return Arrival{.light = {.d = s->d,
                             .distance = s->distance,
                             .weight = s->weight / p_chosen,
                             .pdf = s->pdf * p_chosen},
                   .index = chosen,
                   .p_choice = p_chosen};
  }

  std::optional<LightSample> s = environments_[chosen - lights_.size()]->sample(p, u);
  if (!s) return std::nullopt;
  // What the chosen one contributes is taken from its sample, not looked up again: rounding may
  // put a direction sampled at the edge of a disk outside it.
  Rgb L = s->weight * s->pdf;
  float pdf = p_chosen * s->pdf;
  for (std::size_t i = 0; i < environments_.size(); ++i) {
    const std::size_t index = lights_.size() + i;
    if (index == chosen) continue;
    const EnvironmentLight::View other = environments_[i]->view(s->d);
    L += other.L;
    if (may_choose(index)) pdf += probability(far_importance_[index], total) * other.pdf;
  }
  s->weight = L / pdf;
  s->pdf = pdf;
  return Arrival{.light = *s, .index = chosen, .p_choice = 1.0f};
}

Rgb LightSet::environment_radiance(const Vec3& d) const {
  Rgb L{0.0f};
  for (const auto& environment : environments_) L += environment->radiance(d);
  return L;
}

EnvironmentLight::View LightSet::environment_view(const Vec3& from, const Vec3& d) const {
  const float total = choices_.size() > 1 ? total_importance(from) : 0.0f;
  EnvironmentLight::View sum{.L = Rgb{0.0f}, .pdf = 0.0f};
  for (std::size_t i = 0; i < environments_.size(); ++i) {
    const EnvironmentLight::View view = environments_[i]->view(d);
    sum.L += view.L;
    const std::size_t index = lights_.size() + i;
    if (may_choose(index)) sum.pdf += probability(far_importance_[index], total) * view.pdf;
  }
  return sum;
}

}  // namespace brume
