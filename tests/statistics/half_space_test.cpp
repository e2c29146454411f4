// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include "statistics/cameras.h"
#include "statistics/measure.h"
#include "statistics/quadrature.h"
#include "statistics/scene_text.h"

namespace brume::test {
namespace {

// A slab of optical thickness 32 stands for a half-space: at albedo 0.9 it lets 5e-8 through.
constexpr double kDeep = 32.0;

/// Chandrasekhar's H function for isotropic scattering: the solution of
/// 1/H(mu) = sqrt(1 - albedo) + (albedo/2) int_0^1 x H(x) / (mu + x) dx (Chandrasekhar 1960, ch.
/// V).
class HFunction {
 public:
  explicit HFunction(double albedo) : albedo_(albedo) {
    // x = s^3 gathers nodes at 0, where H has a logarithmic slope.
    integrate(0.0, 1.0, 20, [&](double s) {
      nodes_.push_back(s * s * s);
      return 0.0;
    });
    h_.assign(nodes_.size(), 1.0);
    // Iterates alternate around the solution; their geometric mean does not.
    for (int iteration = 0; iteration < 200; ++iteration) {
      std::vector<double> next;
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        next.push_back(std::sqrt(h_[i] * (*this)(nodes_[i])));
      h_ = next;
    }
  }

  double operator()(double mu) const {
    std::size_t i = 0;  // nodes are visited in order
    const double integral = integrate(0.0, 1.0, 20, [&](double s) {
      const double x = nodes_[i], h = h_[i];
      ++i;
      return 3.0 * s * s * x * h / (mu + x);
    });
    return 1.0 / (std::sqrt(1.0 - albedo_) + 0.5 * albedo_ * integral);
  }

  double plane_albedo(double mu) const { return 1.0 - (*this)(mu)*std::sqrt(1.0 - albedo_); }

 private:
  double albedo_;
  std::vector<double> nodes_, h_;  // x and H(x) where the quadrature looks
};

TEST(HalfSpace, HFunctionIsThatOfTheTables) {
  EXPECT_NEAR(HFunction(0.5)(0.2), 1.113461, 2e-6);
  EXPECT_NEAR(HFunction(0.5)(1.0), 1.251260, 2e-6);
  EXPECT_NEAR(HFunction(0.9)(0.5), 1.556034, 2e-6);
  EXPECT_NEAR(HFunction(0.9)(1.0), 1.850099, 2e-6);
  EXPECT_NEAR(HFunction(1.0)(1.0), 2.907811, 2e-5);
}

struct Incidence {
  double albedo, mu;
};
class HalfSpaceAlbedo : public ::testing::TestWithParam<Incidence> {};

TEST_P(HalfSpaceAlbedo, FollowsTheHFunction) {
  const auto [albedo, mu] = GetParam();
  const RunningMean L =
      measure_radiance({.xml = scene_text(sensor_at_cosine(mu) + kUniformLight +
                                          slab_text(homogeneous_text(kDeep, albedo, 0.0)))});
  expect_law(
      {.name = fmt::format("R of a half-space, isotropic, albedo {:g}, mu0 {:g}", albedo, mu),
       .source = "H function, Chandrasekhar 1960",
       .expected = HFunction(albedo).plane_albedo(mu)},
      L.mean(), L.standard_error());
}
INSTANTIATE_TEST_SUITE_P(, HalfSpaceAlbedo,
                         ::testing::Values(Incidence{0.5, 0.1}, Incidence{0.5, 0.5},
                                           Incidence{0.5, 1.0}, Incidence{0.9, 0.1},
                                           Incidence{0.9, 0.5}, Incidence{0.9, 1.0},
                                           Incidence{0.99, 0.7}));

TEST(HalfSpace, DiffuseReflectanceIsTheIntegralOfTheHFunction) {
  for (const double albedo : {0.5, 0.9}) {
    const HFunction H(albedo);
    const auto camera =
        std::make_shared<const IrradianceCamera>(Vec3(0.0f, 0.501f, 0.0f), Vec3(0.0f, -1.0f, 0.0f));
    const RunningMean L =
        measure_radiance({.xml = scene_text(sensor_at_cosine(1.0) + kUniformLight +
                                            slab_text(homogeneous_text(kDeep, albedo, 0.0))),
                          .camera = camera});
    expect_law(
        {.name = fmt::format("R of a half-space, isotropic, albedo {:g}, diffuse light", albedo),
         .source = "H function, Chandrasekhar 1960",
         .expected =
             integrate(0.0, 1.0, 20, [&](double mu) { return 2.0 * mu * H.plane_albedo(mu); })},
        L.mean(), L.standard_error());
  }
}

struct Reflection {
  double albedo, mu0, mu;
};
class HalfSpaceReflection : public ::testing::TestWithParam<Reflection> {};

TEST_P(HalfSpaceReflection, FollowsTheHFunction) {
  const auto [albedo, mu0, mu] = GetParam();
  // A beam of flux pi across itself.
  const std::string sun = fmt::format(
      R"(<emitter type="directional"><vector name="direction" x="0" y="{:.17g}" z="{:.17g}"/>)"
      R"(<float name="irradiance" value="{:.17g}"/></emitter>)",
      -mu0, std::sqrt(1.0 - mu0 * mu0), M_PI);
  const RunningMean L =
      measure_radiance({.xml = scene_text(sensor_at_cosine(mu) + sun +
                                          slab_text(homogeneous_text(kDeep, albedo, 0.0)))});
  const HFunction H(albedo);
  expect_law({.name = fmt::format(
                  "radiance of a half-space, isotropic, albedo {:g}, mu0 {:g}, seen at mu {:g}",
                  albedo, mu0, mu),
              .source = "H function, Chandrasekhar 1960",
              .expected = 0.25 * albedo * H(mu) * H(mu0) * mu0 / (mu + mu0)},
             L.mean(), L.standard_error());
}
INSTANTIATE_TEST_SUITE_P(, HalfSpaceReflection,
                         ::testing::Values(Reflection{0.5, 1.0, 0.5}, Reflection{0.9, 0.5, 0.8},
                                           Reflection{0.9, 0.2, 0.3}));

TEST(HalfSpace, BehindGlassReflectsWhatGiovanelliFound) {
  const std::string glass = R"(<bsdf type="dielectric"><float name="int_ior" value="1.5"/>)"
                            R"(<float name="ext_ior" value="1"/></bsdf>)";
  const RunningMean L =
      measure_radiance({.xml = scene_text(sensor_at_cosine(1.0) + kUniformLight +
                                          slab_text(homogeneous_text(kDeep, 0.9, 0.0), glass))});
  expect_law({.name = "R of a half-space behind a smooth boundary, n 1.5, isotropic, albedo 0.9, "
                      "normal incidence, specular included",
              .source = "Giovanelli 1955 (0.2600), computed anew to more digits",
              .expected = 0.25992},
             L.mean(), L.standard_error());
}

}  // namespace
}  // namespace brume::test
