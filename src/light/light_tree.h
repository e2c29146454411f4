// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/ray.h"
#include "light/light.h"

namespace brume {

/// Lights that are somewhere, in clusters of clusters, for a choice among many of them whose cost
/// grows with the logarithm of their number (Conty Estevez and Kulla 2018).
///
/// How lights are weighed is the caller's: `Weights` takes the number of a light and returns its
/// weight >= 0, finite in sum; or it takes a cluster and returns the weight of one light in the
/// place of all, or nothing where that is too near for it. Such a cluster is opened, and so is the
/// whole, so that each of few lights, and of those that are near, has the weight of its own.
class LightTree {
 public:
  struct Member {
    std::size_t light;  // its number in the scene
    Light::Pivot pivot;
  };
  LightTree() = default;
  explicit LightTree(std::vector<Member> members);

  std::size_t size() const { return members_.size(); }
  bool contains(std::size_t light) const {
    return light < leaf_of_.size() && leaf_of_[light] != kNone;
  }

  /// Whether a light smaller than `distance` is closer than that to the ray, up to `t_end` [unit].
  bool is_within(float distance, const Ray& ray, float t_end) const {
    return !nodes_.empty() && is_within(nodes_.front(), distance, ray, t_end);
  }

  /// Of all that is opened.
  template <class Weights>
  float total_weight(const Weights& weights) const {
    return nodes_.empty() ? 0.0f : weight(weights, nodes_.front());
  }

  /// Probability that a light has in any case, and for each unit of weight.
  struct Odds {
    float each = 0.0f;
    float per_weight = 0.0f;
  };
  struct Choice {
    std::size_t light = 0;
    float p = 0.0f;  // its probability
  };
  /// `u` is uniform in [0, each size() + per_weight total_weight()). Precondition: size() > 0.
  template <class Weights>
  Choice sample(const Weights& weights, const Odds& odds, float u) const;
  /// Precondition: contains(light).
  template <class Weights>
  float probability(const Weights& weights, const Odds& odds, std::size_t light) const;

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  static constexpr std::size_t kLeafSize = 16;

  struct Node {
    Light::Pivot cluster{};
    Vec3 center{0.0f};  // of a ball around all pivots
    float radius = 0.0f;
    std::uint32_t parent = kNone;
    std::uint32_t child = kNone;       // the first of two beside each other; none in a leaf
    std::uint32_t begin = 0, end = 0;  // of its members
    std::size_t size() const { return end - begin; }
    bool is_leaf() const { return child == kNone; }
  };

  void build(std::uint32_t node);
  bool is_within(const Node& node, float distance, const Ray& ray, float t_end) const;

  /// Weight of a cluster that is not opened.
  template <class Weights>
  std::optional<float> weight_as_one(const Weights& weights, const Node& node) const {
    return node.parent == kNone ? std::nullopt : weights(node.cluster);
  }
  template <class Weights>
  float weight(const Weights& weights, const Node& node) const;

  /// Looks for the choice below `node`; takes the probability of what it passes from `u`. Returns
  /// whether it was found.
  template <class Weights>
  bool find(const Weights& weights, const Odds& odds, const Node& node, float& u,
            Choice& choice) const;
  /// In a cluster that is not opened and has `by_weight` besides what its lights have in any case.
  template <class Weights>
  Choice sample_inside(const Weights& weights, float each, float by_weight, const Node* node,
                       float u) const;

  /// Part of a closed node's share that its first child gets.
  template <class Weights>
  float share_of_first_child(const Weights& weights, const Node& node) const;
  /// Parts of a closed leaf's share that its members get, in their order.
  using Shares = std::array<float, kLeafSize>;
  template <class Weights>
  Shares shares_of_members(const Weights& weights, const Node& leaf) const;

  std::vector<Member> members_;
  std::vector<Node> nodes_;             // the root first
  std::vector<std::uint32_t> leaf_of_;  // [light]; none for those that are not members
};

template <class Weights>
float LightTree::weight(const Weights& weights, const Node& node) const {
  if (const auto as_one = weight_as_one(weights, node)) return *as_one;
  if (!node.is_leaf())
    return weight(weights, nodes_[node.child]) + weight(weights, nodes_[node.child + 1]);
  float sum = 0.0f;
  for (std::size_t i = node.begin; i < node.end; ++i) sum += weights(members_[i].light);
  return sum;
}

template <class Weights>
float LightTree::share_of_first_child(const Weights& weights, const Node& node) const {
  const float first = weight(weights, nodes_[node.child]);
  const float second = weight(weights, nodes_[node.child + 1]);
  return first + second > 0.0f ? first / (first + second) : 0.5f;
}

template <class Weights>
auto LightTree::shares_of_members(const Weights& weights, const Node& leaf) const -> Shares {
  Shares shares;
  float sum = 0.0f;
  for (std::size_t i = 0; i < leaf.size(); ++i)
    sum += shares[i] = weights(members_[leaf.begin + i].light);
  for (std::size_t i = 0; i < leaf.size(); ++i)
    shares[i] = sum > 0.0f ? shares[i] / sum : 1.0f / float(leaf.size());
  return shares;
}

template <class Weights>
LightTree::Choice LightTree::sample(const Weights& weights, const Odds& odds, float u) const {
  assert(size() > 0);
  Choice choice;
  find(weights, odds, nodes_.front(), u, choice);
  // Rounding may leave a rest of `u` behind the last one.
  if (!(choice.p > 0.0f)) {
    choice.light = members_.back().light;
    choice.p = probability(weights, odds, choice.light);
  }
  return choice;
}

template <class Weights>
bool LightTree::find(const Weights& weights, const Odds& odds, const Node& node, float& u,
                     Choice& choice) const {
  if (const auto as_one = weight_as_one(weights, node)) {
    const float by_weight = odds.per_weight * *as_one;
    const float p = odds.each * float(node.size()) + by_weight;
    if (u < p) choice = sample_inside(weights, odds.each, by_weight, &node, u);
    u -= p;
    return u < 0.0f;
  }
  if (!node.is_leaf())
    return find(weights, odds, nodes_[node.child], u, choice) ||
           find(weights, odds, nodes_[node.child + 1], u, choice);
  for (std::size_t i = node.begin; i < node.end; ++i) {
    const float p = odds.each + odds.per_weight * weights(members_[i].light);
    if (p > 0.0f) choice = {.light = members_[i].light, .p = p};
    u -= p;
    if (u < 0.0f) return true;
  }
  return false;
}

template <class Weights>
LightTree::Choice LightTree::sample_inside(const Weights& weights, float each, float by_weight,
                                           const Node* node, float u) const {
  while (!node->is_leaf()) {
    const Node& first = nodes_[node->child];
    const float share = share_of_first_child(weights, *node);
    const float p_first = each * float(first.size()) + by_weight * share;
    const bool takes_first = u < p_first;
    by_weight *= takes_first ? share : 1.0f - share;
    if (!takes_first) u -= p_first;
    node = &first + (takes_first ? 0 : 1);
  }
  const Shares shares = shares_of_members(weights, *node);
  Choice choice;
  for (std::size_t i = 0; i < node->size(); ++i) {
    const float p = each + by_weight * shares[i];
    if (p > 0.0f) choice = {.light = members_[node->begin + i].light, .p = p};
    u -= p;
    if (u < 0.0f) break;
  }
  return choice;
}

template <class Weights>
float LightTree::probability(const Weights& weights, const Odds& odds, std::size_t light) const {
  assert(contains(light));
  // The largest closed cluster that holds the light.
  std::uint32_t closed = kNone;
  float closed_weight = 0.0f;
  for (std::uint32_t at = leaf_of_[light]; at != kNone; at = nodes_[at].parent)
    if (const auto as_one = weight_as_one(weights, nodes_[at])) {
      closed = at;
      closed_weight = *as_one;
    }
  if (closed == kNone) return odds.each + odds.per_weight * weights(light);

  std::uint32_t at = leaf_of_[light];
  std::size_t i = 0;
  while (members_[nodes_[at].begin + i].light != light) ++i;
  float by_weight = odds.per_weight * closed_weight * shares_of_members(weights, nodes_[at])[i];
  for (; at != closed; at = nodes_[at].parent) {
    const Node& parent = nodes_[nodes_[at].parent];
    const float share = share_of_first_child(weights, parent);
    by_weight *= at == parent.child ? share : 1.0f - share;
  }
  return odds.each + by_weight;
}

}  // namespace brume
