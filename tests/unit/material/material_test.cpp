// SPDX-License-Identifier: Apache-2.0
// What single materials do, beyond the laws common to all.
#include <gtest/gtest.h>

#include <memory>

#include "core/rng.h"
#include "core/warp.h"
#include "material/conductor_bsdf.h"
#include "material/dielectric_bsdf.h"
#include "material/diffuse_bsdf.h"
#include "material/fresnel.h"
#include "material/plastic_bsdf.h"
#include "material/rough_conductor_bsdf.h"
#include "material/rough_dielectric_bsdf.h"
#include "material/rough_plastic_bsdf.h"
#include "material/thin_dielectric_bsdf.h"
#include "material/two_sided_bsdf.h"
#include "support/statistics.h"

namespace brume {
namespace {

constexpr Vec2 kUv{0.5f, 0.5f};

std::shared_ptr<const Texture> grey(float value) {
  return std::make_shared<ConstantTexture>(Rgb{value});
}

Vec3 direction(float cos_theta) {
  return spherical_direction(std::sqrt((1.0f - cos_theta) * (1.0f + cos_theta)), cos_theta, 0.7f);
}

/// Light that leaves toward `wo` when light of radiance 1, times the squared index on its side,
/// arrives from everywhere.
test::RunningMean furnace(const Bsdf& bsdf, const Vec3& wo, int samples = 20000) {
  Rng rng(7);
  test::RunningMean mean;
  for (int i = 0; i < samples; ++i) {
    const float u_lobe = rng.next_float();
    const auto s = bsdf.sample(wo, kUv, u_lobe, rng.next_vec2());
    mean.add(s ? s->weight.g * s->eta * s->eta : 0.0);
  }
  return mean;
}

TEST(WhiteFurnace, SmoothWhiteMaterialsLoseNothing) {
  const DiffuseBsdf diffuse(grey(1.0f));
  const DielectricBsdf glass(1.5f, grey(1.0f), grey(1.0f));
  const ThinDielectricBsdf pane(1.5f, grey(1.0f), grey(1.0f));
  const ConductorBsdf mirror(Rgb{0.0f}, Rgb{1.0f}, grey(1.0f));
  const PlasticBsdf plastic(1.49f, grey(1.0f), grey(1.0f), true);
  for (const float cos_theta : {1.0f, 0.6f, 0.2f, 0.01f}) {
    const Vec3 wo = direction(cos_theta);
    EXPECT_TRUE(test::agrees(furnace(diffuse, wo), 1.0, 1e-6));
    EXPECT_TRUE(test::agrees(furnace(glass, wo), 1.0, 1e-6));
    EXPECT_TRUE(test::agrees(furnace(glass, -wo), 1.0, 1e-6));
    EXPECT_TRUE(test::agrees(furnace(pane, wo), 1.0, 1e-6));
    EXPECT_TRUE(test::agrees(furnace(mirror, wo), 1.0, 1e-6));
    // 1 - F_in is integrated to about 1e-5.
    EXPECT_TRUE(test::agrees(furnace(plastic, wo), 1.0, 1e-4)) << cos_theta;
  }
}

TEST(WhiteFurnace, SlightRoughnessLosesLittle) {
  const Microfacets slight(MicrofacetType::kGgx, 0.05f, 0.05f);
  const RoughConductorBsdf metal(slight, Rgb{0.0f}, Rgb{1.0f}, grey(1.0f));
  const RoughDielectricBsdf glass(slight, 1.5f, grey(1.0f), grey(1.0f));
  const RoughPlasticBsdf plastic(slight, 1.49f, grey(1.0f), grey(1.0f), true);
  for (const float cos_theta : {1.0f, 0.5f}) {
    for (const Bsdf* bsdf : {static_cast<const Bsdf*>(&metal), static_cast<const Bsdf*>(&glass),
                             static_cast<const Bsdf*>(&plastic)}) {
      const double got = furnace(*bsdf, direction(cos_theta)).mean();
      EXPECT_GT(got, bsdf == &plastic ? 0.95 : 0.99);
      EXPECT_LT(got, 1.001);
    }
  }
}

TEST(WhiteFurnace, RoughPlasticNeverGains) {
  for (const float alpha : {0.1f, 0.4f, 1.0f}) {
    for (const MicrofacetType type : {MicrofacetType::kBeckmann, MicrofacetType::kGgx}) {
      const RoughPlasticBsdf plastic({type, alpha, alpha}, 1.49f, grey(1.0f), grey(1.0f), true);
      for (const float cos_theta : {1.0f, 0.6f, 0.2f, 0.05f}) {
        const test::RunningMean got = furnace(plastic, direction(cos_theta));
        EXPECT_LT(got.mean(), 1.0 + test::kMaxZ * got.standard_error())
            << alpha << " " << cos_theta;
      }
    }
  }
}

TEST(DielectricBsdf, RadianceInGlassIsHigherByTheSquaredIndex) {
  const DielectricBsdf glass(1.5f, grey(1.0f), grey(1.0f));
  const auto entering = glass.sample(direction(0.8f), kUv, 0.999f, {0.5f, 0.5f});
  ASSERT_TRUE(entering);
  EXPECT_LT(entering->wi.z, 0.0f);
  EXPECT_FLOAT_EQ(entering->eta, 1.5f);
  EXPECT_NEAR(entering->weight.g, 1.0f / (1.5f * 1.5f), 1e-6f);
  const auto leaving = glass.sample(entering->wi, kUv, 0.999f, {0.5f, 0.5f});
  ASSERT_TRUE(leaving);
  EXPECT_NEAR(leaving->weight.g, 1.5f * 1.5f, 1e-6f);
  EXPECT_NEAR(glm::length(leaving->wi - direction(0.8f)), 0.0f, 1e-6f);
  EXPECT_FALSE(leaving->straight);
}

TEST(DielectricBsdf, TotalReflectionReflectsAlways) {
  const DielectricBsdf glass(1.5f, grey(1.0f), grey(1.0f));
  const auto s = glass.sample(direction(-0.3f), kUv, kOneMinusEpsilon, {0.5f, 0.5f});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, reflect(direction(-0.3f)));
  EXPECT_EQ(s->weight, Rgb{1.0f});
}

TEST(ThinDielectricBsdf, SumsReflectionsBetweenItsFaces) {
  const ThinDielectricBsdf pane(1.5f, grey(1.0f), grey(1.0f));
  const double R = double(fresnel_dielectric(0.4f, 1.5f).R);
  double transmitted = 0.0;
  for (int n = 0; n < 40; ++n) transmitted += (1.0 - R) * (1.0 - R) * std::pow(R, 2 * n);
  EXPECT_NEAR(pane.straight_transmittance(direction(0.4f), kUv).g, transmitted, 1e-6);
  EXPECT_NEAR(pane.straight_transmittance(direction(-0.4f), kUv).g, transmitted, 1e-6);
}

TEST(TwoSidedBsdf, EachSideIsItsOwnMaterial) {
  const auto dark = std::make_shared<DiffuseBsdf>(grey(0.2f));
  const auto bright = std::make_shared<DiffuseBsdf>(grey(0.8f));
  const TwoSidedBsdf both(dark, bright);
  const Vec3 up = direction(0.7f), down = direction(-0.7f);
  EXPECT_FLOAT_EQ(both.eval(up, up, kUv).g, 0.2f * 0.7f / kPi);
  EXPECT_FLOAT_EQ(both.eval(down, down, kUv).g, 0.8f * 0.7f / kPi);
  EXPECT_EQ(both.eval(up, down, kUv), Rgb{0.0f});
  EXPECT_LT(both.sample(down, kUv, 0.5f, {0.3f, 0.3f})->wi.z, 0.0f);
  EXPECT_EQ(dark->eval(down, down, kUv), Rgb{0.0f});
}

TEST(PlasticBsdf, AlbedoIsTheMeanOverDiffuseLight) {
  for (const bool nonlinear : {false, true}) {
    const PlasticBsdf smooth(1.49f, grey(0.5f), grey(1.0f), nonlinear);
    const RoughPlasticBsdf rough({MicrofacetType::kGgx, 0.2f, 0.2f}, 1.49f, grey(0.5f), grey(1.0f),
                                 nonlinear);
    for (const Bsdf* bsdf : {static_cast<const Bsdf*>(&smooth), static_cast<const Bsdf*>(&rough)}) {
      Rng rng(8);
      test::RunningMean mean;
      for (int i = 0; i < 100000; ++i) {
        const Vec3 wo = sample_cosine_hemisphere(rng.next_vec2());
        const float u_lobe = rng.next_float();
        const auto s = bsdf->sample(wo, kUv, u_lobe, rng.next_vec2());
        mean.add(s ? s->weight.g : 0.0);
      }
      EXPECT_TRUE(test::agrees(mean, double(bsdf->albedo(kUv).g), 1e-4));
    }
  }
}

TEST(RoughBsdf, AlmostEqualIndicesPassLightAlmostStraight) {
  // The lobe is 1e-4 wide, where float directions are good to 1e-7: finite, and nothing is lost.
  const Microfacets rough(MicrofacetType::kBeckmann, 0.1f, 0.1f);
  const RoughDielectricBsdf air_in_vacuum(rough, 1.000277f, grey(1.0f), grey(1.0f));
  Rng rng(10);
  for (const float cos_theta : {1.0f, 0.5f, -0.5f}) {
    const Vec3 wo = direction(cos_theta);
    test::RunningMean mean;
    for (int i = 0; i < 5000; ++i) {
      const float u_lobe = rng.next_float();
      const auto s = air_in_vacuum.sample(wo, kUv, u_lobe, rng.next_vec2());
      mean.add(s ? s->weight.g * s->eta * s->eta : 0.0);
      if (!s) continue;
      ASSERT_TRUE(s->pdf > 0.0f && std::isfinite(s->pdf));
      if (s->eta != 1.0f) {
        ASSERT_LT(glm::length(s->wi + wo), 3e-3f);
      }
    }
    EXPECT_NEAR(mean.mean(), 1.0, 2e-3) << cos_theta;
  }
}

TEST(RoughBsdf, TinyRoughnessIsTheSmoothMaterial) {
  const Microfacets tiny(MicrofacetType::kBeckmann, 0.0f, 0.0f);
  const RoughDielectricBsdf rough(tiny, 1.5f, grey(1.0f), grey(1.0f));
  const DielectricBsdf smooth(1.5f, grey(1.0f), grey(1.0f));
  Rng rng(9);
  for (const float cos_theta : {0.9f, 0.4f, -0.9f, -0.4f}) {
    const Vec3 wo = direction(cos_theta);
    for (int i = 0; i < 1000; ++i) {
      const float u_lobe = rng.next_float();
      const auto a = rough.sample(wo, kUv, u_lobe, rng.next_vec2());
      const auto b = smooth.sample(wo, kUv, u_lobe, {0.5f, 0.5f});
      ASSERT_TRUE(a && b);
      if (a->wi.z * b->wi.z < 0.0f) continue;  // u_lobe fell between the two reflectances
      EXPECT_NEAR(glm::length(a->wi - b->wi), 0.0f, 3e-3f);
      EXPECT_NEAR(a->weight.g, b->weight.g, 1e-4f);
      EXPECT_TRUE(a->pdf > 1e3f && std::isfinite(a->pdf));
    }
  }
}

}  // namespace
}  // namespace brume
