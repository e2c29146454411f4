// SPDX-License-Identifier: Apache-2.0
#include "light/light_set.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "light/importance.h"

namespace brume {
namespace {

/// Part of the choices among lights that does not look at their importance.
constexpr float kUniformPart = 0.2f;

}  // namespace

struct LightSet::ImportanceAt {
  const Vec3& p;
  const LightSet& lights;

  float operator()(std::size_t light) const { return lights.lights_[light]->importance(p); }
  std::optional<float> operator()(const Light::Pivot& cluster) const {
    return importance_as_one(cluster, p, 2.0f);
  }
};

LightSet::LightSet(std::vector<std::shared_ptr<const Light>> lights,
                   std::vector<std::shared_ptr<const EnvironmentLight>> environments)
    : lights_(std::move(lights)), environments_(std::move(environments)) {
  far_importance_.resize(size(), 0.0f);
  std::vector<LightTree::Member> with_pivot;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (const auto pivot = lights_[i]->pivot()) {
      with_pivot.push_back({.light = i, .pivot = *pivot});
    } else {
      far_importance_[i] = lights_[i]->importance(Vec3(0.0f));
      far_choices_.push_back(i);
    }
  }
  for (std::size_t i = lights_.size(); i < size(); ++i) {
    far_importance_[i] = environments_[i - lights_.size()]->importance(Vec3(0.0f));
    if (far_importance_[i] > 0.0f) far_choices_.push_back(i);
  }
  for (const float importance : far_importance_) importance_without_pivot_ += importance;
  with_pivot_ = LightTree(std::move(with_pivot));
}

LightTree::Odds LightSet::odds_at(const Vec3& p) const {
  const std::size_t choices = with_pivot_.size() + far_choices_.size();
  if (choices <= 1) return {.each = 1.0f};
  const float uniform = 1.0f / float(choices);
  const float total = importance_without_pivot_ + with_pivot_.total_weight(ImportanceAt{p, *this});
  if (!(total > kLeastImportance)) return {.each = uniform};
  return {.each = kUniformPart * uniform, .per_weight = (1.0f - kUniformPart) / total};
}

bool LightSet::may_choose(std::size_t index) const {
  return with_pivot_.contains(index) ||
         std::binary_search(far_choices_.begin(), far_choices_.end(), index);
}

float LightSet::probability(const Vec3& p, std::size_t index) const {
  assert(index < size());
  if (!may_choose(index)) return 0.0f;
  const LightTree::Odds odds = odds_at(p);
  return with_pivot_.contains(index) ? with_pivot_.probability(ImportanceAt{p, *this}, odds, index)
                                     : probability(odds, index);
}

std::optional<LightSet::Arrival> LightSet::sample(const Vec3& p, float u_choice,
                                                  const Vec2& u) const {
  if (with_pivot_.size() + far_choices_.size() == 0) return std::nullopt;
  const LightTree::Odds odds = odds_at(p);
  const float p_far =
      odds.each * float(far_choices_.size()) + odds.per_weight * importance_without_pivot_;
  LightTree::Choice choice;
  if (with_pivot_.size() > 0 && (far_choices_.empty() || u_choice < 1.0f - p_far)) {
    choice = with_pivot_.sample(ImportanceAt{p, *this}, odds, u_choice);
  } else {
    float remaining = u_choice - (1.0f - p_far);
    for (const std::size_t i : far_choices_) {
      choice = {.light = i, .p = probability(odds, i)};
      remaining -= choice.p;
      if (remaining < 0.0f) break;
    }
  }
  const auto [chosen, p_chosen] = choice;

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
    pdf += probability(odds, index) * other.pdf;
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
  const LightTree::Odds odds = odds_at(from);
  EnvironmentLight::View sum{.L = Rgb{0.0f}, .pdf = 0.0f};
  for (std::size_t i = 0; i < environments_.size(); ++i) {
    const EnvironmentLight::View view = environments_[i]->view(d);
    sum.L += view.L;
    const std::size_t index = lights_.size() + i;
    sum.pdf += probability(odds, index) * view.pdf;
  }
  return sum;
}

}  // namespace brume
