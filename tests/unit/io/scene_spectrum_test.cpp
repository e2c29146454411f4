// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "io/spectrum.h"

namespace brume {
namespace {

void expect_near(const glm::dvec3& got, const glm::dvec3& want, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], want[i], tolerance) << "channel " << i;
}

TEST(SpectrumToRgb, AConstantReflectanceIsGrey) {
  expect_near(reflectance_to_rgb({.wavelengths_nm = {}, .values = {0.3}}), glm::dvec3(0.3), 0.0);
  expect_near(reflectance_to_rgb({{300, 900}, {0.3, 0.3}}), glm::dvec3(0.3), 1e-12);
}

// White in Rec. 709 is D65, not equal energy; Mitsuba 3 has the same numbers.
TEST(SpectrumToRgb, EqualEnergyLightIsReddish) {
  const glm::dvec3 want(1.2048, 0.9483, 0.9089);
  expect_near(emission_to_rgb({.wavelengths_nm = {}, .values = {1.0}}), want, 1e-4);
  expect_near(emission_to_rgb({{300, 900}, {2.0, 2.0}}), 2.0 * want, 2e-4);
}

TEST(SpectrumToRgb, IsLinearInTheSpectrum) {
  const Spectrum a{{400, 500, 700}, {0.1, 0.7, 0.2}}, b{{400, 500, 700}, {0.4, 0.0, 0.5}};
  const Spectrum sum{{400, 500, 700}, {0.5, 0.7, 0.7}};
  expect_near(reflectance_to_rgb(sum), reflectance_to_rgb(a) + reflectance_to_rgb(b), 1e-12);
  expect_near(emission_to_rgb(sum), emission_to_rgb(a) + emission_to_rgb(b), 1e-12);
}

TEST(SpectrumToRgb, IsZeroOutsideItsWavelengths) {
  const Spectrum left{{400, 550}, {1, 1}}, right{{550, 700}, {1, 1}}, all{{400, 700}, {1, 1}};
  expect_near(emission_to_rgb(left) + emission_to_rgb(right), emission_to_rgb(all), 1e-3);
  expect_near(emission_to_rgb({{900, 1000}, {1, 1}}), glm::dvec3(0.0), 0.0);
}

// A narrow band at 555 nm has luminance y(555) = 1 per nanometre over the integral 106.857 nm of y.
TEST(SpectrumToRgb, ANarrowGreenBandHasTheLuminanceOfTheStandardObserver) {
  const glm::dvec3 c = emission_to_rgb({{553, 554, 556, 557}, {0, 1, 1, 0}});
  const double luminance = 0.212671 * c.r + 0.715160 * c.g + 0.072169 * c.b;
  EXPECT_NEAR(luminance, 3.0 / 106.857, 1e-4);
  EXPECT_LT(c.b, 0.0);  // outside the gamut
}

// The red wall of the Cornell box as measured; reference value by summation of the CIE tables at
// 5 nm in an independent program.
TEST(SpectrumToRgb, AMeasuredRedPaintIsRed) {
  const Spectrum red{{400, 440, 480, 520, 560, 580, 600, 620, 640, 660, 680, 700},
                     {.04, .059, .06, .057, .067, .099, .287, .513, .609, .638, .642, .642}};
  const glm::dvec3 c = reflectance_to_rgb(red);
  EXPECT_NEAR(c.r, 0.49, 0.01);
  EXPECT_NEAR(c.g, 0.05, 0.01);
  EXPECT_NEAR(c.b, 0.05, 0.01);
}

}  // namespace
}  // namespace brume
