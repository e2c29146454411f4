// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_path_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "core/rng.h"
#include "core/warp.h"
#include "unit/integrator/lit_scenes.h"

namespace brume::test {
namespace {

using Lanes = LightPathSet::Lanes;
using Seen = LightPathSet::Seen;

constexpr int kUnlimited = std::numeric_limits<int>::max();
constexpr float kReach = 0.7f, kSigmaT = 0.4f;
constexpr int kPathsPerBundle = 5;
const Vec3 kReceiver{0.1f, 0.4f, 0.3f};

struct Kept {
  LightVertex vertex;
  float p_kept;
};

/// Places anywhere in the foggy room, a third of them on its surfaces.
std::vector<Kept> random_places(const Scene& scene, std::size_t count, Rng& rng) {
  std::vector<Kept> places;
  while (places.size() < count) {
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    LightVertex vertex{
        .p = Vec3(rng.next_float(), rng.next_float(), rng.next_float()) * 3.6f - 1.8f,
        .d = d,
        .power = Rgb(rng.next_float(), rng.next_float(), rng.next_float()) + 0.05f,
        .scatterings = 1 + int(4.0f * rng.next_float()),
        .medium = nullptr,
        .phase = {1.6f * rng.next_float() - 0.8f}};
    if (rng.next_float() < 0.33f) {
      const auto hit = scene.intersect({.o = vertex.p, .d = d}, kInfinity);
      if (!hit || !(glm::dot(d, hit->n) < 0.0f)) continue;
      vertex.p = hit->p;
      vertex.hit = hit;
      vertex.phase = {};
    }
    // One that is hardly ever chosen would take more random numbers than a test has time for.
    const Vec3 d_out = glm::normalize(kReceiver - vertex.p);
    const float value = luminance(scattered_toward(scene, vertex, d_out));
    if (value > 0.0f && value < 0.005f) continue;
    // Metal out of sight may be chosen, for nothing.
    if (value == 0.0f && vertex.hit && scene.bsdf(*vertex.hit).mirror_lobe()) continue;
    places.push_back({vertex, 0.1f + 0.9f * rng.next_float()});
  }
  return places;
}

/// Whether light may go from the place to the receiver, occlusion apart.
bool is_in_sight(const Scene& scene, const LightVertex& vertex) {
  const Vec3 d = glm::normalize(kReceiver - vertex.p);
  return luminance(scattered_toward(scene, vertex, d)) > 0.0f;
}

/// Any positive function of a place.
double h(const LightVertex& vertex) {
  return 2.0 + std::sin(5.0 * vertex.p.x) + std::cos(7.0 * vertex.p.y + vertex.p.z);
}

/// Light seen from all around, more from some directions.
const auto kSeen = [](const Lanes& x, const Lanes& y, const Lanes& z) {
  const Lanes value = 0.3f + 0.1f * x - 0.1f * y + 0.05f * z;
  return Seen{value, 0.5f * value};
};

class ChosenPlaces : public ::testing::Test {
 protected:
  const TestScene scene_ = lit_scene(kFoggyRoom);
  const Scene& scene() const { return *scene_.loaded().scene; }

  /// Holds that the mean of weight times h over `u` is the sum over the bundle of what is allowed.
  void expect_stand_for_all(const LightPathSet& set, std::uint32_t bundle,
                            const std::vector<Kept>& places, int most_scatterings) {
    double want = 0.0;
    int allowed = 0;
    for (const Kept& place : places)
      if (place.vertex.scatterings <= most_scatterings && is_in_sight(scene(), place.vertex)) {
        want += h(place.vertex) / (double(place.p_kept) * kPathsPerBundle);
        ++allowed;
      }
    constexpr int kStrata = 1 << 16;
    double got = 0.0;
    std::map<const LightVertex*, double> chosen;  // weight times h
    for (int i = 0; i < kStrata; ++i) {
      const float u = (float(i) + 0.5f) / kStrata;
      const auto choice = set.choose(bundle, kReceiver, most_scatterings, kSeen, u);
      ASSERT_EQ(choice.has_value(), allowed > 0);
      if (!choice) continue;
      ASSERT_LE(choice->vertex->scatterings, most_scatterings);
      const double value = double(choice->weight) * h(*choice->vertex);
      chosen[choice->vertex] = value;
      got += value / kStrata;
    }
    // The strata at the two ends of a place's interval may fall to it or to its neighbours.
    double tolerance = 1e-5 * want;
    for (const auto& [vertex, value] : chosen) tolerance += 2.0 / kStrata * value;
    EXPECT_EQ(int(chosen.size()), allowed);
    EXPECT_NEAR(got, want, tolerance);
    EXPECT_LE(tolerance, 0.02 * want);
  }
};

TEST_F(ChosenPlaces, StandForAllOfTheirBundle) {
  Rng rng(1);
  LightPathSet set(scene(), kReach, kSigmaT, kPathsPerBundle);
  std::vector<std::vector<Kept>> bundles;
  for (const std::size_t count : {3, 0, 8, 1, 9, 16, 37, 0, 64, 83}) {
    bundles.push_back(random_places(scene(), count, rng));
    for (const Kept& place : bundles.back()) set.add(place.vertex, place.p_kept);
    set.end_bundle();
  }
  for (std::uint32_t bundle = 0; bundle < bundles.size(); ++bundle)
    for (const int most_scatterings : {kUnlimited, 4, 2, 1, 0}) {
      SCOPED_TRACE(::testing::Message() << "bundle " << bundle << ", " << most_scatterings);
      expect_stand_for_all(set, bundle, bundles[bundle], most_scatterings);
    }
}

TEST_F(ChosenPlaces, AreFoundForTheLargestRandomNumber) {
  Rng rng(2);
  for (std::size_t count = 1; count < 60; ++count) {
    LightPathSet set(scene(), kReach, kSigmaT, kPathsPerBundle);
    for (Kept& place : random_places(scene(), count, rng)) {
      place.vertex.hit.reset();  // every place is in sight
      place.vertex.power *= std::pow(10.0f, 4.0f * rng.next_float());
      set.add(place.vertex, place.p_kept);
    }
    set.end_bundle();
    for (const float u : {0.0f, 1.0f - 0x1p-24f}) {
      const auto choice = set.choose(0, kReceiver, kUnlimited, kSeen, u);
      ASSERT_TRUE(choice) << count;
      EXPECT_GT(max_component(choice->vertex->power), 0.0f) << count;
      EXPECT_TRUE(std::isfinite(choice->weight)) << count;
    }
  }
}

TEST_F(ChosenPlaces, AreNoneWhereNoLightCouldArrive) {
  Rng rng(3);
  LightPathSet set(scene(), kReach, kSigmaT, kPathsPerBundle);
  for (Kept& place : random_places(scene(), 20, rng)) {
    place.vertex.power = Rgb{0.0f};
    set.add(place.vertex, place.p_kept);
  }
  set.end_bundle();
  for (const Kept& place : random_places(scene(), 20, rng)) set.add(place.vertex, place.p_kept);
  set.end_bundle();
  const auto nothing_seen = [](const Lanes&, const Lanes&, const Lanes&) {
    return Seen{Lanes(0.0f), Lanes(0.0f)};
  };
  EXPECT_FALSE(set.choose(0, kReceiver, kUnlimited, kSeen, 0.5f));
  EXPECT_FALSE(set.choose(1, kReceiver, kUnlimited, nothing_seen, 0.5f));
  EXPECT_TRUE(set.choose(1, kReceiver, kUnlimited, kSeen, 0.5f));
}

/// However narrow the lobe that stands for what it reflects.
TEST_F(ChosenPlaces, MayBeOnMetalWhereverItReflectsTo) {
  Rng rng(4);
  for (const float alpha : {0.001f, 0.1f, 0.5f, 1.0f}) {
    const TestScene room = lit_scene(
        "<shape type=\"rectangle\"><bsdf type=\"twosided\"><bsdf type=\"roughconductor\">"
        "<string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"" +
        std::to_string(alpha) + "\"/></bsdf></bsdf></shape>");
    const Scene& plate = *room.loaded().scene;
    int reflecting = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 d = sample_uniform_sphere(rng.next_vec2());
      const auto hit = plate.intersect({.o = -d, .d = d}, kInfinity);
      if (!hit) continue;
      const LightVertex vertex{
          .p = hit->p, .d = d, .power = Rgb{1.0f}, .scatterings = 1, .medium = nullptr, .hit = hit};
      LightPathSet set(plate, kReach, kSigmaT, 1);
      set.add(vertex, 1.0f);
      set.end_bundle();
      const Vec3 d_out = sample_uniform_sphere(rng.next_vec2());
      if (is_black(scattered_toward(plate, vertex, d_out))) continue;
      ++reflecting;
      const auto choice = set.choose(0, hit->p + d_out, kUnlimited, kSeen, 0.5f);
      ASSERT_TRUE(choice) << alpha;
      EXPECT_FLOAT_EQ(choice->weight, 1.0f);
    }
    EXPECT_GT(reflecting, 100) << alpha;
  }
}

/// Surfaces as smooth normals show them: a place is seen wherever it scatters to.
TEST_F(ChosenPlaces, MayBeWhereOnlyTheShadingNormalFacesTheReceiver) {
  for (const std::string& bsdf :
       {std::string("<bsdf type=\"diffuse\"/>"),
        std::string("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>")}) {
    const TestScene room = lit_scene("<shape type=\"rectangle\">" + bsdf + "</shape>");
    const Scene& plate = *room.loaded().scene;
    // The normal is +Z, the receiver almost in the plane and below it.
    auto hit = plate.intersect({.o = Vec3(0, 0, 1), .d = Vec3(0, 0, -1)}, kInfinity);
    ASSERT_TRUE(hit);
    hit->n_shading = glm::normalize(Vec3(0.5f, 0.0f, 1.0f));
    const LightVertex vertex{.p = hit->p,
                             .d = glm::normalize(Vec3(-0.2f, 0.0f, -1.0f)),
                             .power = Rgb{1.0f},
                             .scatterings = 1,
                             .medium = nullptr,
                             .hit = hit};
    const Vec3 p(2.0f, 0.0f, -0.2f);
    LightPathSet set(plate, kReach, kSigmaT, 1);
    set.add(vertex, 1.0f);
    set.end_bundle();
    const bool scatters = !is_black(scattered_toward(plate, vertex, glm::normalize(p - vertex.p)));
    EXPECT_EQ(set.choose(0, p, kUnlimited, kSeen, 0.5f).has_value(), scatters) << bsdf;
  }
}

}  // namespace
}  // namespace brume::test
