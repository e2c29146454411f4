// SPDX-License-Identifier: Apache-2.0
#include "light/light_tree.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/warp.h"
#include "light/importance.h"
#include "support/chi_square.h"

namespace brume {
namespace {

/// Lamps of any brightness in [-1, 1]^3; every third has a number, so that others are not members.
std::vector<LightTree::Member> lamps(int count) {
  Rng rng(11);
  std::vector<LightTree::Member> members;
  for (int i = 0; i < count; ++i) {
    const float x = rng.next_float(), y = rng.next_float(), z = rng.next_float();
    members.push_back({.light = std::size_t(3 * i),
                       .pivot = {.center = 2.0f * Vec3(x, y, z) - 1.0f,
                                 .radius = 0.0f,
                                 .intensity = 0.1f + rng.next_float()}});
  }
  return members;
}

/// Weights as they are at a point. Lights in a tenth of the room shine elsewhere.
struct At {
  const std::vector<LightTree::Member>& members;
  Vec3 p;

  float operator()(std::size_t light) const {
    const Light::Pivot& lamp = members[light / 3].pivot;
    return lamp.center.x < -0.8f ? 0.0f : finite(lamp.intensity / length_squared(lamp.center - p));
  }
  std::optional<float> operator()(const Light::Pivot& cluster) const {
    return importance_as_one(cluster, p, 2.0f);
  }
};

constexpr std::array kPlaces{Vec3(0.0f), Vec3(0.9f, -0.9f, 0.3f), Vec3(4.0f, 1.0f, 0.0f),
                             Vec3(-300.0f, 0.0f, 20.0f)};

LightTree::Odds odds(const LightTree& tree, const At& at, float uniform_part) {
  return {.each = uniform_part / float(tree.size()),
          .per_weight = (1.0f - uniform_part) / tree.total_weight(at)};
}

TEST(LightTree, ProbabilitiesAddUpToOne) {
  for (const int count : {1, 2, 16, 17, 100, 1000}) {
    const auto members = lamps(count);
    const LightTree tree(members);
    ASSERT_EQ(tree.size(), members.size());
    for (const Vec3& p : kPlaces) {
      const At at{members, p};
      double sum = 0.0;
      for (const auto& member : members)
        sum += tree.probability(at, odds(tree, at, 0.2f), member.light);
      EXPECT_NEAR(sum, 1.0, 2e-5) << count << " lamps";
    }
  }
}

TEST(LightTree, KnowsItsMembers) {
  const LightTree tree(lamps(100));
  EXPECT_TRUE(tree.contains(0));
  EXPECT_TRUE(tree.contains(297));
  EXPECT_FALSE(tree.contains(1));
  EXPECT_FALSE(tree.contains(300));
  EXPECT_FALSE(LightTree().contains(0));
  EXPECT_EQ(LightTree().size(), 0u);
}

TEST(LightTree, SamplesFollowTheirProbabilities) {
  constexpr int kSamples = 200000;
  for (const int count : {3, 40, 300}) {
    const auto members = lamps(count);
    const LightTree tree(members);
    for (const Vec3& p : kPlaces) {
      const At at{members, p};
      const LightTree::Odds how = odds(tree, at, 0.2f);
      std::vector<double> found(members.size(), 0.0);
      Rng rng(5);
      for (int i = 0; i < kSamples; ++i) {
        const LightTree::Choice choice = tree.sample(at, how, rng.next_float());
        ++found[choice.light / 3];
        ASSERT_NEAR(choice.p, tree.probability(at, how, choice.light), 1e-4f * choice.p);
      }
      double chi_square = 0.0;
      for (const auto& member : members) {
        const double expected = kSamples * double(tree.probability(at, how, member.light));
        const double off = found[member.light / 3] - expected;
        chi_square += off * off / expected;
      }
      EXPECT_GT(test::upper_gamma(0.5 * (count - 1), 0.5 * chi_square), 1e-4) << count << " lamps";
    }
  }
}

TEST(LightTree, WeighsFewLightsEachByItself) {
  const auto members = lamps(16);
  const LightTree tree(members);
  const At at{members, kPlaces[2]};
  float total = 0.0f;
  for (const auto& member : members) total += at(member.light);
  EXPECT_FLOAT_EQ(tree.total_weight(at), total);
  for (const auto& member : members)
    EXPECT_FLOAT_EQ(tree.probability(at, {.per_weight = 1.0f / total}, member.light),
                    at(member.light) / total);
}

TEST(LightTree, WeighsNearLightsOfManyEachByItself) {
  const auto members = lamps(1000);
  const LightTree tree(members);
  for (const auto& member : {members[17], members[400], members[999]}) {
    const Vec3 p = member.pivot.center + Vec3(0.01f, 0.0f, 0.0f);
    const At at{members, p};
    float total = 0.0f;
    for (const auto& other : members) total += at(other.light);
    const float exact = at(member.light) / total;
    EXPECT_NEAR(tree.probability(at, {.per_weight = 1.0f / tree.total_weight(at)}, member.light),
                exact, 0.02f * exact);
  }
}

TEST(LightTree, TakesLightsFarAwayForOne) {
  const auto members = lamps(1000);
  const LightTree tree(members);
  int asked = 0;
  const auto at = [&](const auto& what) {
    ++asked;
    return At{members, {30.0f, 0.0f, 0.0f}}(what);
  };
  tree.sample(at, {.per_weight = 1.0f / tree.total_weight(at)}, 0.4f);
  EXPECT_LT(asked, 60);
}

TEST(LightTree, FindsLightsBesideARay) {
  constexpr float kDistance = 0.05f;
  for (const int count : {1, 16, 100, 1000}) {
    auto members = lamps(count);
    // Those that are larger than the distance are not sought.
    for (std::size_t i = 0; i < members.size(); i += 4) members[i].pivot.radius = 0.06f;
    const LightTree tree(members);
    Rng rng(3);
    int near = 0;
    for (int i = 0; i < 4000; ++i) {
      const float x = rng.next_float(), y = rng.next_float(), z = rng.next_float();
      const Ray ray{3.0f * Vec3(x, y, z) - 1.5f,
                    sample_uniform_sphere({rng.next_float(), rng.next_float()})};
      const float t_end = i % 3 == 0 ? kInfinity : 2.0f * rng.next_float();
      bool expected = false;
      for (const auto& member : members) {
        const Vec3 to_lamp = member.pivot.center - ray.o;
        const float t = std::clamp(glm::dot(to_lamp, ray.d), 0.0f, t_end);
        expected |= member.pivot.radius < kDistance && glm::length(to_lamp - t * ray.d) < kDistance;
      }
      EXPECT_EQ(tree.is_within(kDistance, ray, t_end), expected) << count << " lamps, ray " << i;
      near += expected ? 1 : 0;
    }
    if (count > 1) EXPECT_GT(near, 10) << count << " lamps";
  }
  EXPECT_FALSE(LightTree().is_within(1.0f, {Vec3(0.0f), {0.0f, 0.0f, 1.0f}}, kInfinity));
}

TEST(LightTree, HoldsManyLightsInOnePlace) {
  auto members = lamps(200);
  for (auto& member : members) member.pivot.center = Vec3(0.5f);
  const LightTree tree(members);
  for (const Vec3& p : {Vec3(0.5f), Vec3(0.6f, 0.5f, 0.5f)}) {
    const At at{members, p};
    ASSERT_TRUE(std::isfinite(tree.total_weight(at)));
    const auto choice = tree.sample(at, odds(tree, at, 0.2f), 0.7f);
    EXPECT_GT(choice.p, 0.0f);
  }
}

TEST(LightTree, IsDarkOfLightsThatDoNotShine) {
  auto members = lamps(40);
  for (auto& member : members) member.pivot.intensity = 0.0f;
  const LightTree tree(members);
  const At at{members, Vec3(3.0f)};
  EXPECT_EQ(tree.total_weight(at), 0.0f);
  EXPECT_GT(tree.sample(at, {.each = 1.0f / 40.0f}, 0.99f).p, 0.0f);
}

}  // namespace
}  // namespace brume
