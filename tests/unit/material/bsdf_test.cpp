// SPDX-License-Identifier: Apache-2.0
// Laws that every BSDF obeys.
#include "material/bsdf.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/warp.h"
#include "material/conductor_bsdf.h"
#include "material/dielectric_bsdf.h"
#include "material/diffuse_bsdf.h"
#include "material/null_bsdf.h"
#include "material/plastic_bsdf.h"
#include "material/rough_conductor_bsdf.h"
#include "material/rough_dielectric_bsdf.h"
#include "material/rough_plastic_bsdf.h"
#include "material/thin_dielectric_bsdf.h"
#include "material/two_sided_bsdf.h"
#include "support/chi_square.h"
#include "support/statistics.h"

namespace brume {
namespace {

constexpr Vec2 kUv{0.3f, 0.6f};
constexpr auto kBeckmann = MicrofacetType::kBeckmann;
constexpr auto kGgx = MicrofacetType::kGgx;

std::shared_ptr<const Texture> grey(float value) {
  return std::make_shared<ConstantTexture>(Rgb{value});
}
std::shared_ptr<const Texture> coloured() {
  return std::make_shared<ConstantTexture>(Rgb{0.9f, 0.5f, 0.1f});
}
std::shared_ptr<const Bsdf> rough_metal(const Microfacets& microfacets) {
  return std::make_shared<RoughConductorBsdf>(microfacets, Rgb{0.2f, 0.9f, 1.1f},
                                              Rgb{3.9f, 2.4f, 2.1f}, grey(1.0f));
}
std::shared_ptr<const Bsdf> rough_glass(const Microfacets& microfacets, float eta) {
  return std::make_shared<RoughDielectricBsdf>(microfacets, eta, grey(1.0f), grey(1.0f));
}
std::shared_ptr<const Bsdf> rough_plastic(const Microfacets& microfacets, bool nonlinear) {
  return std::make_shared<RoughPlasticBsdf>(microfacets, 1.49f, coloured(), grey(1.0f), nonlinear);
}

struct Case {
  std::string name;
  std::shared_ptr<const Bsdf> bsdf;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

std::vector<Case> cases() {
  const auto diffuse = std::make_shared<DiffuseBsdf>(coloured());
  const auto metal = rough_metal({kGgx, 0.3f, 0.3f});
  return {
      {"diffuse", diffuse},
      {"two_sided", std::make_shared<TwoSidedBsdf>(diffuse, metal)},
      {"two_sided_metal",
       std::make_shared<TwoSidedBsdf>(metal, rough_metal({kBeckmann, 0.2f, 0.1f}))},
      {"null", std::make_shared<NullBsdf>()},
      {"dielectric", std::make_shared<DielectricBsdf>(1.5f, coloured(), grey(1.0f))},
      {"thin_dielectric", std::make_shared<ThinDielectricBsdf>(1.5f, grey(1.0f), coloured())},
      {"conductor",
       std::make_shared<ConductorBsdf>(Rgb{0.2f, 0.9f, 1.1f}, Rgb{3.9f, 2.4f, 2.1f}, grey(1.0f))},
      {"plastic", std::make_shared<PlasticBsdf>(1.49f, coloured(), grey(1.0f), false)},
      {"plastic_nonlinear", std::make_shared<PlasticBsdf>(1.9f, coloured(), coloured(), true)},
      {"rough_conductor_beckmann_0_05", rough_metal({kBeckmann, 0.05f, 0.05f})},
      {"rough_conductor_beckmann_0_4", rough_metal({kBeckmann, 0.4f, 0.4f})},
      {"rough_conductor_beckmann_brushed", rough_metal({kBeckmann, 0.1f, 0.5f})},
      {"rough_conductor_ggx_0_1", rough_metal({kGgx, 0.1f, 0.1f})},
      {"rough_conductor_ggx_1", rough_metal({kGgx, 1.0f, 1.0f})},
      {"rough_conductor_ggx_brushed", rough_metal({kGgx, 0.6f, 0.15f})},
      {"rough_dielectric_beckmann_0_1", rough_glass({kBeckmann, 0.1f, 0.1f}, 1.5f)},
      {"rough_dielectric_beckmann_0_6", rough_glass({kBeckmann, 0.6f, 0.6f}, 1.33f)},
      {"rough_dielectric_ggx_0_05", rough_glass({kGgx, 0.05f, 0.05f}, 2.4f)},
      {"rough_dielectric_ggx_brushed", rough_glass({kGgx, 0.2f, 0.7f}, 1.5f)},
      {"rough_dielectric_bubble", rough_glass({kGgx, 0.3f, 0.3f}, 1.0f / 1.5f)},
      {"rough_dielectric_index_1_1", rough_glass({kBeckmann, 0.5f, 0.5f}, 1.1f)},
      {"rough_plastic_beckmann_0_1", rough_plastic({kBeckmann, 0.1f, 0.1f}, false)},
      {"rough_plastic_ggx_0_5", rough_plastic({kGgx, 0.5f, 0.5f}, true)},
  };
}

/// Outside and inside; normal, oblique and grazing incidence.
std::vector<Vec3> outgoing() {
  std::vector<Vec3> directions;
  for (const float cos_theta : {1.0f, 0.7f, 0.3f, 0.02f, -0.02f, -0.5f, -0.9f}) {
    const float sin_theta = std::sqrt((1.0f - cos_theta) * (1.0f + cos_theta));
    directions.push_back(spherical_direction(sin_theta, cos_theta, 0.7f));
  }
  return directions;
}

class BsdfLaw : public ::testing::TestWithParam<Case> {
 protected:
  const Bsdf& bsdf_ = *GetParam().bsdf;
};

TEST_P(BsdfLaw, SamplesFollowPdf) {
  if (!bsdf_.has_smooth_lobe()) {
    for (const Vec3& wo : outgoing()) EXPECT_EQ(bsdf_.pdf(wo, -wo, kUv), 0.0f);
    return;
  }
  for (const Vec3& wo : outgoing()) {
    const auto sample = [&](Rng& rng) -> std::optional<test::DirectionSample> {
      const float u_lobe = rng.next_float();
      const std::optional<BsdfSample> s = bsdf_.sample(wo, kUv, u_lobe, rng.next_vec2());
      if (!s || s->pdf == kInfinity) return std::nullopt;
      return test::DirectionSample{.d = s->wi, .pdf = s->pdf};
    };
    const auto pdf = [&](const Vec3& wi) { return bsdf_.pdf(wo, wi, kUv); };
    EXPECT_TRUE(test::samples_follow_pdf(sample, pdf, {.pdf_tolerance = 0.01f}))
        << "wo.z = " << wo.z;
  }
}

TEST_P(BsdfLaw, WeightIsValueOverPdf) {
  Rng rng(2);
  for (const Vec3& wo : outgoing()) {
    for (int i = 0; i < 2000; ++i) {
      const float u_lobe = rng.next_float();
      const std::optional<BsdfSample> s = bsdf_.sample(wo, kUv, u_lobe, rng.next_vec2());
      if (!s) continue;
      ASSERT_NEAR(glm::length(s->wi), 1.0f, 1e-5f);
      ASSERT_TRUE(is_finite_and_non_negative(s->weight));
      if (s->pdf == kInfinity) continue;
      const Rgb value = bsdf_.eval(wo, s->wi, kUv);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(s->weight[c] * s->pdf, value[c], 1e-3f * value[c] + 1e-6f) << "wo.z = " << wo.z;
      }
    }
  }
}

/// What `mirror_lobe` stands for is reflected, and no further from the mirror direction than that.
TEST_P(BsdfLaw, MirrorLobeIsWideEnough) {
  const auto lobe = bsdf_.mirror_lobe();
  if (!lobe) return;
  EXPECT_GE(*lobe, 0.0f);
  EXPECT_LT(*lobe, 1.0f);
  Rng rng(4);
  const Vec3 wo = glm::normalize(Vec3(0.3f, 0.2f, 1.0f));
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 20000; ++i) {
    const float u_lobe = rng.next_float();
    const auto s = bsdf_.sample(wo, kUv, u_lobe, rng.next_vec2());
    if (!s) continue;
    ASSERT_LT(s->pdf, kInfinity);
    ASSERT_GT(s->wi.z * wo.z, 0.0f);
    sum += glm::dot(s->wi, Vec3(-wo.x, -wo.y, wo.z));
    ++count;
  }
  EXPECT_LE(*lobe, sum / count);
}

TEST_P(BsdfLaw, NoEnergyIsCreated) {
  Rng rng(3);
  for (const Vec3& wo : outgoing()) {
    test::RunningMean mean[3];
    for (int i = 0; i < 20000; ++i) {
      const float u_lobe = rng.next_float();
      const std::optional<BsdfSample> s = bsdf_.sample(wo, kUv, u_lobe, rng.next_vec2());
      // Light in thermal equilibrium has a radiance proportional to the squared index.
      for (int c = 0; c < 3; ++c) mean[c].add(s ? s->weight[c] * s->eta * s->eta : 0.0);
    }
    for (const test::RunningMean& m : mean) {
      EXPECT_LE(m.mean(), 1.0 + 1e-5 + test::kMaxZ * m.standard_error()) << "wo.z = " << wo.z;
    }
  }
}

TEST_P(BsdfLaw, LightRunsBothWays) {
  Rng rng(4);
  for (const Vec3& wo : outgoing()) {
    for (int i = 0; i < 2000; ++i) {
      const float u_lobe = rng.next_float();
      const std::optional<BsdfSample> s = bsdf_.sample(wo, kUv, u_lobe, rng.next_vec2());
      if (!s || s->pdf == kInfinity || std::abs(s->wi.z) < 1e-3f) continue;
      // f(wo, wi) eta^2 = f(wi, wo) for radiance (Veach 1997, eq. 5.14).
      const Rgb there = bsdf_.eval(wo, s->wi, kUv) / std::abs(s->wi.z) * (s->eta * s->eta);
      const Rgb back = bsdf_.eval(s->wi, wo, kUv) / std::abs(wo.z);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(there[c], back[c], 2e-3f * there[c] + 1e-5f) << "wo.z = " << wo.z;
      }
    }
  }
}

TEST_P(BsdfLaw, StraightLightIsWhatSamplingSendsStraight) {
  Rng rng(5);
  for (const Vec3& wo : outgoing()) {
    test::RunningMean mean[3];
    for (int i = 0; i < 5000; ++i) {
      const float u_lobe = rng.next_float();
      const std::optional<BsdfSample> s = bsdf_.sample(wo, kUv, u_lobe, rng.next_vec2());
      const bool straight = s && s->straight;
      if (straight) {
        ASSERT_EQ(s->wi, -wo);
      }
      for (int c = 0; c < 3; ++c) mean[c].add(straight ? s->weight[c] : 0.0);
    }
    const Rgb want = bsdf_.straight_transmittance(wo, kUv);
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(test::agrees(mean[c], want[c], 1e-6));
  }
}

TEST_P(BsdfLaw, ExtremeNumbersGiveFiniteValues) {
  const float numbers[] = {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon};
  for (const float cos_theta : {1.0f, 1e-3f, 1e-7f, 1e-20f, 0.0f, -1e-20f, -1e-3f, -1.0f}) {
    const float sin_theta = std::sqrt((1.0f - cos_theta) * (1.0f + cos_theta));
    const Vec3 wo = spherical_direction(sin_theta, cos_theta, 0.1f);
    for (const float u_lobe : numbers) {
      for (const float x : numbers) {
        for (const float y : numbers) {
          const std::optional<BsdfSample> s = bsdf_.sample(wo, kUv, u_lobe, {x, y});
          if (!s) continue;
          ASSERT_NEAR(glm::length(s->wi), 1.0f, 1e-5f);
          ASSERT_GT(s->pdf, 0.0f);
          ASSERT_TRUE(is_finite_and_non_negative(s->weight)) << "wo.z = " << wo.z;
        }
      }
    }
    for (const float z : {1.0f, 1e-20f, 0.0f, -1e-7f, -1.0f}) {
      const Vec3 wi = spherical_direction(std::sqrt((1.0f - z) * (1.0f + z)), z, 2.0f);
      ASSERT_TRUE(is_finite_and_non_negative(bsdf_.eval(wo, wi, kUv))) << wo.z << " " << z;
      ASSERT_TRUE(std::isfinite(bsdf_.pdf(wo, wi, kUv))) << wo.z << " " << z;
    }
    for (const Vec3& wi : {wo, -wo, Vec3(-wo.x, -wo.y, wo.z)}) {
      ASSERT_TRUE(is_finite_and_non_negative(bsdf_.eval(wo, wi, kUv))) << wo.z;
      ASSERT_TRUE(std::isfinite(bsdf_.pdf(wo, wi, kUv))) << wo.z;
    }
  }
}

TEST_P(BsdfLaw, AlbedoLiesInTheUnitInterval) {
  const Rgb albedo = bsdf_.albedo(kUv);
  EXPECT_GT(min_component(albedo), 0.0f);
  EXPECT_LE(max_component(albedo), 1.0f);
}

INSTANTIATE_TEST_SUITE_P(All, BsdfLaw, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace brume
