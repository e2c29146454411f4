// SPDX-License-Identifier: Apache-2.0
#include "material/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

namespace brume {
namespace {

TEST(DielectricFresnel, NormalIncidenceHasAClosedForm) {
  for (const float eta : {1.000277f, 1.33f, 1.5f, 2.4f}) {
    const float want = (eta - 1.0f) * (eta - 1.0f) / ((eta + 1.0f) * (eta + 1.0f));
    EXPECT_NEAR(fresnel_dielectric(1.0f, eta).R, want, 1e-4f * want + 1e-10f);
    EXPECT_NEAR(fresnel_dielectric(-1.0f, eta).R, want, 1e-4f * want + 1e-10f);
  }
}

TEST(DielectricFresnel, OnlyPerpendicularLightReflectsAtBrewstersAngle) {
  for (const float eta : {1.33f, 1.5f, 2.4f}) {
    // There reflected and refracted light are perpendicular: R_p = 0 and R_s is a closed form.
    const float cos_i = 1.0f / std::sqrt(1.0f + eta * eta);
    const float r_s = (1.0f - eta * eta) / (1.0f + eta * eta);
    EXPECT_NEAR(fresnel_dielectric(cos_i, eta).R, 0.5f * r_s * r_s, 1e-6f);
  }
}

TEST(DielectricFresnel, NothingLeavesBeyondTheCriticalAngle) {
  const float eta = 1.5f;
  const float critical = std::sqrt(1.0f - 1.0f / (eta * eta));
  EXPECT_EQ(fresnel_dielectric(-0.99f * critical, eta).R, 1.0f);
  EXPECT_LT(fresnel_dielectric(-1.01f * critical, eta).R, 1.0f);
  EXPECT_LT(fresnel_dielectric(0.99f * critical, eta).R, 1.0f);
  EXPECT_EQ(fresnel_dielectric(0.0f, eta).R, 1.0f);
}

TEST(DielectricFresnel, BothSidesAgreeAlongARefractedRay) {
  for (const float cos_i : {1.0f, 0.8f, 0.3f, 0.05f}) {
    const DielectricFresnel in = fresnel_dielectric(cos_i, 1.7f);
    ASSERT_LT(in.cos_t, 0.0f);
    EXPECT_EQ(in.eta, 1.7f);
    const DielectricFresnel out = fresnel_dielectric(in.cos_t, 1.7f);
    EXPECT_NEAR(out.R, in.R, 1e-5f);
    EXPECT_NEAR(out.cos_t, cos_i, 1e-5f);
    EXPECT_FLOAT_EQ(out.eta, 1.0f / 1.7f);
  }
}

TEST(DielectricFresnel, EqualIndicesReflectNothing) {
  for (const float cos_i : {1.0f, 0.1f, 0.0f, -0.5f}) {
    const DielectricFresnel f = fresnel_dielectric(cos_i, 1.0f);
    EXPECT_EQ(f.R, 0.0f);
    EXPECT_EQ(f.cos_t, -cos_i);
  }
}

TEST(ConductorFresnel, EqualIndicesReflectNothing) {
  for (int i = 0; i <= 1000; ++i) {
    const float R = fresnel_conductor(float(i) / 1000.0f, Rgb{1.0f}, Rgb{0.0f}).r;
    EXPECT_GE(R, 0.0f) << i;
    EXPECT_LE(R, 1e-5f) << i;
  }
}

TEST(DielectricFresnel, RefractionObeysSnellsLaw) {
  const Vec3 m = glm::normalize(Vec3(0.2f, -0.3f, 0.9f));
  const Vec3 w = glm::normalize(Vec3(0.7f, 0.1f, 0.5f));
  const DielectricFresnel f = fresnel_dielectric(glm::dot(w, m), 1.5f);
  const Vec3 t = refract(w, m, f);
  EXPECT_NEAR(glm::length(t), 1.0f, 1e-6f);
  const Vec3 tangential = (w - glm::dot(w, m) * m) + 1.5f * (t - glm::dot(t, m) * m);
  EXPECT_NEAR(glm::length(tangential), 0.0f, 1e-6f);
  EXPECT_LT(glm::dot(t, m), 0.0f);
}

TEST(DiffuseFresnelReflectance, BothSidesAreTiedByTheSquaredIndex) {
  for (const float eta : {1.1f, 1.33f, 1.5f, 2.0f, 3.0f}) {
    // What enters and leaves is the same in equilibrium: (1 - F_in) eta^2 = 1 - F_out.
    const float inside = diffuse_fresnel_reflectance(1.0f / eta);
    EXPECT_NEAR((1.0f - inside) * eta * eta, 1.0f - diffuse_fresnel_reflectance(eta), 1e-4f);
  }
}

TEST(DiffuseFresnelReflectance, MatchesWalshsIntegral) {
  // Walsh 1926, in the form of Duntley 1942, eq. 10.
  for (const float eta : {1.2f, 1.33f, 1.5f, 2.0f, 3.0f}) {
    const double n = double(eta), n2 = n * n, n4 = n2 * n2;
    const double want =
        0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) +
        n2 * (n2 - 1.0) * (n2 - 1.0) / std::pow(n2 + 1.0, 3) * std::log((n - 1.0) / (n + 1.0)) -
        2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0)) +
        8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0) * (n4 - 1.0)) * std::log(n);
    EXPECT_NEAR(double(diffuse_fresnel_reflectance(eta)), want, 2e-5) << eta;
  }
}

/// Straight from the amplitudes, in complex double.
double conductor_reference(double cos_i, double eta, double k) {
  const std::complex<double> n(eta, k);
  const std::complex<double> n_cos_t = std::sqrt(n * n - (1.0 - cos_i * cos_i));
  const std::complex<double> r_s = (cos_i - n_cos_t) / (cos_i + n_cos_t);
  const std::complex<double> r_p = (n * n * cos_i - n_cos_t) / (n * n * cos_i + n_cos_t);
  return 0.5 * (std::norm(r_s) + std::norm(r_p));
}

TEST(ConductorFresnel, MatchesTheComplexAmplitudes) {
  const Rgb eta{0.2f, 1.65f, 4.4f}, k{3.9f, 9.2f, 3.5f};
  for (const float cos_i : {1.0f, 0.9f, 0.5f, 0.1f, 0.001f}) {
    const Rgb R = fresnel_conductor(cos_i, eta, k);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(R[c], conductor_reference(double(cos_i), double(eta[c]), double(k[c])), 2e-6);
    }
  }
}

TEST(ConductorFresnel, WithoutAbsorptionIsADielectric) {
  for (const float cos_i : {1.0f, 0.6f, 0.2f}) {
    EXPECT_NEAR(fresnel_conductor(cos_i, Rgb{1.5f}, Rgb{0.0f}).g, fresnel_dielectric(cos_i, 1.5f).R,
                2e-6f);
  }
}

TEST(ConductorFresnel, TheIndexOfAPerfectMirrorReflectsEverything) {
  for (const float cos_i : {1.0f, 0.5f, 0.0f}) {
    EXPECT_EQ(fresnel_conductor(cos_i, Rgb{0.0f}, Rgb{1.0f}), Rgb{1.0f});
    EXPECT_EQ(fresnel_conductor(cos_i, Rgb{0.0f}, Rgb{0.0f}), Rgb{1.0f});
  }
}

}  // namespace
}  // namespace brume
