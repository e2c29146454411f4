// SPDX-License-Identifier: Apache-2.0
#include "medium/similar_medium.h"

#include <gtest/gtest.h>

namespace brume {
namespace {

TEST(SimilarCoefficients, KeepAbsorptionAndReduceScattering) {
  const Rgb albedo(0.0f, 0.7f, 1.0f);
  for (const float g : {-0.9f, 0.0f, 0.3f, 0.99f}) {
    const SimilarCoefficients similar = similar_coefficients(albedo, g);
    for (int c = 0; c < 3; ++c) {
      const float sigma_s = similar.extinction_scale[c] * similar.albedo[c];
      const float sigma_a = similar.extinction_scale[c] * (1.0f - similar.albedo[c]);
      EXPECT_NEAR(sigma_s, (1.0f - g) * albedo[c], 1e-6f);
      EXPECT_NEAR(sigma_a, 1.0f - albedo[c], 1e-6f);
    }
  }
}

TEST(SimilarCoefficients, OfLightThatGoesStraightOnAreVacuum) {
  const SimilarCoefficients similar = similar_coefficients(Rgb(1.0f), 1.0f);
  EXPECT_EQ(similar.extinction_scale, Rgb(0.0f));
  EXPECT_EQ(similar.albedo, Rgb(0.0f));
}

}  // namespace
}  // namespace brume
