// SPDX-License-Identifier: Apache-2.0
#include "support/chi_square.h"

#include <gtest/gtest.h>

#include "core/warp.h"

namespace brume {
namespace {

using test::DirectionSample;

float cosine_pdf(const Vec3& d) {
  return std::max(0.0f, d.z) / kPi;
}

std::optional<DirectionSample> sample_cosine(Rng& rng) {
  const Vec3 d = sample_cosine_hemisphere(rng.next_vec2());
  return DirectionSample{.d = d, .pdf = cosine_pdf(d)};
}

TEST(UpperGamma, MatchesClosedForms) {
  for (const double x : {0.01, 0.5, 2.0, 7.0, 40.0}) {
    EXPECT_NEAR(test::upper_gamma(1.0, x) / std::exp(-x), 1.0, 1e-12);
    EXPECT_NEAR(test::upper_gamma(0.5, x) / std::erfc(std::sqrt(x)), 1.0, 1e-12);
    EXPECT_NEAR(test::upper_gamma(3.0, x) / (std::exp(-x) * (1.0 + x + 0.5 * x * x)), 1.0, 1e-12);
  }
  EXPECT_EQ(test::upper_gamma(400.0, 0.0), 1.0);
  EXPECT_NEAR(test::upper_gamma(400.0, 400.0), 0.5, 0.01);
}

TEST(ChiSquare, AcceptsExactSamplers) {
  EXPECT_TRUE(test::samples_follow_pdf(sample_cosine, cosine_pdf));
  const auto uniform_pdf = [](const Vec3&) { return 0.25f / kPi; };
  const auto sample_uniform = [&](Rng& rng) -> std::optional<DirectionSample> {
    return DirectionSample{.d = sample_uniform_sphere(rng.next_vec2()), .pdf = 0.25f / kPi};
  };
  EXPECT_TRUE(test::samples_follow_pdf(sample_uniform, uniform_pdf,
                                       {.axis = glm::normalize(Vec3(1.0f, 2.0f, -3.0f))}));
}

TEST(ChiSquare, CountsSamplesThatFindNothing) {
  const auto half = [](Rng& rng) {
    const bool finds_nothing = rng.next_float() < 0.5f;
    std::optional<DirectionSample> s = sample_cosine(rng);
    s->pdf *= 0.5f;
    return finds_nothing ? std::nullopt : s;
  };
  const auto half_pdf = [](const Vec3& d) { return 0.5f * cosine_pdf(d); };
  EXPECT_TRUE(test::samples_follow_pdf(half, half_pdf));
  const auto more_pdf = [](const Vec3& d) { return 0.52f * cosine_pdf(d); };
  EXPECT_FALSE(test::samples_follow_pdf(half, more_pdf, {.pdf_tolerance = 1.0f}));
}

TEST(ChiSquare, RejectsWrongDensities) {
  const auto tilted = [](const Vec3& d) { return cosine_pdf(d) * (1.0f + 0.2f * d.x); };
  EXPECT_FALSE(test::samples_follow_pdf(sample_cosine, tilted, {.pdf_tolerance = 1.0f}));
  EXPECT_FALSE(test::samples_follow_pdf(sample_cosine, tilted));
  const auto doubled = [](const Vec3& d) { return 2.0f * cosine_pdf(d); };
  EXPECT_FALSE(test::samples_follow_pdf(sample_cosine, doubled, {.pdf_tolerance = 1.0f}));
  const auto below = [](const Vec3& d) { return cosine_pdf(-d); };
  EXPECT_FALSE(test::samples_follow_pdf(sample_cosine, below));
}

}  // namespace
}  // namespace brume
