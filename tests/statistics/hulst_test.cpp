// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "statistics/measure.h"
#include "statistics/scene_text.h"

namespace brume::test {
namespace {

/// Reflectance and transmittance of a published slab at cosine `mu0`.
void expect_published(const std::string& slab, const std::string& source, double mu0, double R,
                      double T, const std::string& medium) {
  const auto means =
      measure({.xml = scene_text(sensor_at_cosine(mu0) + slab_text(medium) + kHalfLitSky),
               .write_files = write_half_lit_sky},
              [](const CameraSample& s) {
                return std::vector<double>{s.L.r, s.L.g};
              });
  expect_law({.name = "R of " + slab, .source = source, .expected = R}, means[0].mean(),
             means[0].standard_error());
  expect_law({.name = "T of " + slab, .source = source, .expected = T}, means[1].mean(),
             means[1].standard_error());
}

// sigma_a 10/cm, sigma_s 90/cm, g 0.75, thickness 0.02 cm (also in Wang et al. 1995).
constexpr double kTau = 2.0, kAlbedo = 0.9, kG = 0.75;

TEST(Hulst, ForwardScatteringSlab) {
  expect_published("van de Hulst's slab, g 0.75, albedo 0.9, tau 2, normal incidence",
                   "van de Hulst 1980, table 35", 1.0, 0.09739, 0.66096,
                   homogeneous_text(kTau, kAlbedo, kG));
}

TEST(Hulst, IsotropicSlabAtSixtyDegrees) {
  expect_published("an isotropic slab, albedo 0.99, tau 1, mu0 0.5",
                   "van de Hulst 1980, vol. 1, p. 256", 0.5, 0.48652, 0.49163,
                   homogeneous_text(1.0, 0.99, 0.0));
}

struct Angle {
  double mu, reflection, transmission;
};
class HulstAngles : public ::testing::TestWithParam<Angle> {};

TEST_P(HulstAngles, RadianceIsThatOfTheTable) {
  const Angle& angle = GetParam();
  // A beam along the normal of flux pi across itself: radiance is the tabulated function.
  const std::string sun =
      R"(<emitter type="directional"><vector name="direction" x="0" y="-1" z="0"/>)"
      R"(<float name="irradiance" value="3.14159265358979"/></emitter>)";
  const std::string slab = slab_text(homogeneous_text(kTau, kAlbedo, kG));
  const double sine = std::sqrt(1.0 - angle.mu * angle.mu);
  const auto expect = [&](const char* what, double y, double value) {
    // From above or below, at the middle of the face.
    const std::string sensor =
        parallel_sensor({0.0, y, 0.0}, {sine, -2.0 * y * angle.mu, 0.0}, 1.0);
    const RunningMean L = measure_radiance({.xml = scene_text(sensor + sun + slab)});
    expect_law(
        {.name = fmt::format("{} function of van de Hulst's slab at mu {:g}", what, angle.mu),
         .source = "van de Hulst 1980, table 35",
         .expected = value},
        L.mean(), L.standard_error());
  };
  expect("reflection", 0.5, angle.reflection);
  expect("transmission", -0.5, angle.transmission);
}
INSTANTIATE_TEST_SUITE_P(, HulstAngles,
                         ::testing::Values(Angle{0.1, .13304, .16486}, Angle{0.3, .13856, .22473},
                                           Angle{0.5, .11956, .27785}, Angle{0.7, .09411, .36889},
                                           Angle{0.9, .07132, .72155},
                                           Angle{1.0, .06180, 2.40270}));

}  // namespace
}  // namespace brume::test
