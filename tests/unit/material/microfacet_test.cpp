// SPDX-License-Identifier: Apache-2.0
#include "material/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/warp.h"
#include "support/chi_square.h"

namespace brume {
namespace {

struct Roughness {
  MicrofacetType type;
  float u, v;
};

class MicrofacetLaw : public ::testing::TestWithParam<Roughness> {
 protected:
  Microfacets microfacets_{GetParam().type, GetParam().u, GetParam().v};
};

Vec3 direction(float cos_theta, float phi) {
  return spherical_direction(std::sqrt((1.0f - cos_theta) * (1.0f + cos_theta)), cos_theta, phi);
}

/// Integral over the upper hemisphere in tan(theta), where the lobes are about as wide as their
/// roughness.
template <typename F>
double integrate_normals(float alpha, const F& f) {
  constexpr int kTheta = 4000, kPhi = 64;
  double sum = 0.0;
  for (int i = 0; i < kTheta; ++i) {
    const double x = (i + 0.5) / kTheta;
    const double tan_theta = double(alpha) * x / (1.0 - x);
    const double cos_theta = 1.0 / std::sqrt(1.0 + tan_theta * tan_theta);
    const double jacobian = double(alpha) / ((1.0 - x) * (1.0 - x)) * tan_theta * cos_theta *
                            cos_theta * cos_theta;  // dtan/dx sin dtheta/dtan
    for (int j = 0; j < kPhi; ++j) {
      const float phi = 2.0f * kPi * (float(j) + 0.5f) / kPhi;
      const Vec3 m = spherical_direction(float(tan_theta * cos_theta), float(cos_theta), phi);
      sum += f(m) * jacobian;
    }
  }
  return sum * 2.0 * M_PI / (kTheta * kPhi);
}

TEST_P(MicrofacetLaw, ProjectedFacetAreaIsTheSurfaceArea) {
  const float alpha = std::sqrt(GetParam().u * GetParam().v);
  EXPECT_NEAR(
      integrate_normals(alpha, [&](const Vec3& m) { return double(microfacets_.D(m) * m.z); }), 1.0,
      1e-3);
}

TEST_P(MicrofacetLaw, VisibleFacetsCoverTheProjectedSurface) {
  // Heitz 2014, section 3: what is visible of all facets adds up to the surface seen from wo.
  const float alpha = std::sqrt(GetParam().u * GetParam().v);
  for (const float cos_theta : {1.0f, 0.6f, 0.2f}) {
    const Vec3 wo = direction(cos_theta, 0.4f);
    const double total = integrate_normals(
        alpha, [&](const Vec3& m) { return double(microfacets_.pdf_visible(wo, m)); });
    EXPECT_NEAR(total, 1.0, 2e-3) << "cos " << cos_theta;
  }
}

TEST_P(MicrofacetLaw, VisibleNormalsFollowTheirDensity) {
  for (const float cos_theta : {1.0f, 0.5f, 0.05f, 1e-6f}) {
    const Vec3 wo = direction(cos_theta, 2.2f);
    const auto sample = [&](Rng& rng) -> std::optional<test::DirectionSample> {
      const Vec3 m = microfacets_.sample_visible(wo, rng.next_vec2());
      return test::DirectionSample{.d = m, .pdf = microfacets_.pdf_visible(wo, m)};
    };
    const auto pdf = [&](const Vec3& m) { return microfacets_.pdf_visible(wo, m); };
    EXPECT_TRUE(test::samples_follow_pdf(sample, pdf, {.cosine_bins = 40})) << "cos " << cos_theta;
  }
}

TEST_P(MicrofacetLaw, ShadowingFallsTowardGrazingAngles) {
  const Vec3 m(0.0f, 0.0f, 1.0f);
  float previous = 1.0f;
  for (const float cos_theta : {1.0f, 0.8f, 0.5f, 0.2f, 0.05f, 0.001f}) {
    const float G1 = microfacets_.G1(direction(cos_theta, 1.0f), m);
    EXPECT_LE(G1, previous);
    EXPECT_GT(G1, 0.0f);
    previous = G1;
  }
  EXPECT_EQ(microfacets_.G1(Vec3(0.0f, 0.0f, 1.0f), m), 1.0f);
}

TEST_P(MicrofacetLaw, BacksOfFacetsAreNeverSeen) {
  const Vec3 m = direction(0.5f, 0.0f);  // leans away from the viewer
  const Vec3 v = direction(0.3f, kPi);
  ASSERT_LT(glm::dot(v, m), 0.0f);
  EXPECT_EQ(microfacets_.G1(v, m), 0.0f);
  EXPECT_EQ(microfacets_.G1(-v, m), 0.0f);
  EXPECT_EQ(microfacets_.pdf_visible(v, m), 0.0f);
}

TEST_P(MicrofacetLaw, ExtremeRandomNumbersGiveFiniteNormals) {
  for (const float u : {0.0f, 0x1p-32f, 0.5f, kOneMinusEpsilon}) {
    for (const float v : {0.0f, 0.5f, kOneMinusEpsilon}) {
      for (const float cos_theta : {1.0f, 0.5f, 1e-7f, 1e-20f}) {
        const Vec3 m = microfacets_.sample_visible(direction(cos_theta, 0.1f), {u, v});
        EXPECT_NEAR(glm::length(m), 1.0f, 1e-5f);
        EXPECT_GE(m.z, 0.0f);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Roughnesses, MicrofacetLaw,
                         ::testing::Values(Roughness{MicrofacetType::kBeckmann, 0.05f, 0.05f},
                                           Roughness{MicrofacetType::kBeckmann, 0.3f, 0.3f},
                                           Roughness{MicrofacetType::kBeckmann, 1.0f, 1.0f},
                                           Roughness{MicrofacetType::kBeckmann, 0.2f, 0.6f},
                                           Roughness{MicrofacetType::kGgx, 0.05f, 0.05f},
                                           Roughness{MicrofacetType::kGgx, 0.3f, 0.3f},
                                           Roughness{MicrofacetType::kGgx, 1.0f, 1.0f},
                                           Roughness{MicrofacetType::kGgx, 0.2f, 0.6f}));

}  // namespace
}  // namespace brume
