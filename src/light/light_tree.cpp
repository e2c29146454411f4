// SPDX-License-Identifier: Apache-2.0
#include "light/light_tree.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/box.h"

namespace brume {
namespace {

/// Seen from far away, lights together shine as their sum does from their middle. The mean square
/// of the distances to them is that to the middle and the square of the cluster's radius.
Light::Pivot cluster_of(std::span<const LightTree::Member> members) {
  double intensity = 0.0;
  for (const auto& member : members) intensity += member.pivot.intensity;
  const auto share = [&](const LightTree::Member& member) {
    return intensity > 0.0 ? member.pivot.intensity / intensity : 1.0 / double(members.size());
  };
  glm::dvec3 center(0.0);
  for (const auto& member : members) center += share(member) * glm::dvec3(member.pivot.center);
  double square = 0.0;
  for (const auto& member : members) {
    const glm::dvec3 from_center = glm::dvec3(member.pivot.center) - center;
    const double radius = member.pivot.radius;
    square += share(member) * (glm::dot(from_center, from_center) + radius * radius);
  }
  return {.center = center, .radius = float(std::sqrt(square)), .intensity = float(intensity)};
}

double distance_between(const Ray& ray, float t_end, const Vec3& p) {
  const glm::dvec3 to_p = glm::dvec3(p) - glm::dvec3(ray.o), d(ray.d);
  return glm::length(to_p - std::clamp(glm::dot(to_p, d), 0.0, double(t_end)) * d);
}

}  // namespace

LightTree::LightTree(std::vector<Member> members) : members_(std::move(members)) {
  if (members_.empty()) return;
  nodes_.push_back({.begin = 0, .end = std::uint32_t(members_.size())});
  build(0);
}

void LightTree::build(std::uint32_t node) {
  const std::uint32_t begin = nodes_[node].begin, end = nodes_[node].end;
  const std::span<Member> members(members_.data() + begin, end - begin);
  nodes_[node].cluster = cluster_of(members);
  Box3 box;
  for (const Member& member : members) box.extend(member.pivot.center);
  nodes_[node].center = box.center();
  nodes_[node].radius = 0.5f * glm::length(box.size());
  if (members.size() <= kLeafSize) {
    for (const Member& member : members) {
      if (leaf_of_.size() <= member.light) leaf_of_.resize(member.light + 1, kNone);
      leaf_of_[member.light] = node;
    }
    return;
  }

  const Vec3 size = box.size();
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(members_.begin() + begin, members_.begin() + middle, members_.begin() + end,
                   [&](const Member& a, const Member& b) {
                     return std::pair(a.pivot.center[axis], a.light) <
                            std::pair(b.pivot.center[axis], b.light);
                   });
  const auto child = std::uint32_t(nodes_.size());
  nodes_[node].child = child;
  nodes_.push_back({.parent = node, .begin = begin, .end = middle});
  nodes_.push_back({.parent = node, .begin = middle, .end = end});
  build(child);
  build(child + 1);
}

bool LightTree::is_within(const Node& node, float distance, const Ray& ray, float t_end) const {
  if (!node.is_leaf())
    return distance_between(ray, t_end, node.center) < double(distance) + node.radius &&
           (is_within(nodes_[node.child], distance, ray, t_end) ||
            is_within(nodes_[node.child + 1], distance, ray, t_end));
  const std::span<const Member> members(members_.data() + node.begin, node.size());
  return std::ranges::any_of(members, [&](const Member& member) {
    return member.pivot.radius < distance &&
           distance_between(ray, t_end, member.pivot.center) < distance;
  });
}

}  // namespace brume
