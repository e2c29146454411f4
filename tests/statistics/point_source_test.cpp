// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "statistics/cameras.h"
#include "statistics/measure.h"
#include "statistics/quadrature.h"
#include "statistics/scene_text.h"

// A small sphere that shines into an infinite isotropically scattering medium, with the mean free
// path as the unit of length. (A point light would do, but what scatters next to it makes the
// variance of the square of 1/r^2 infinite, and error bars meaningless.)

namespace brume::test {
namespace {

/// Fluence around an isotropic point source of unit power in an infinite isotropic medium of
/// albedo c (Case and Zweifel 1967, ch. 5): the inverse Fourier transform of
/// A / (1 - c A), A(k) = atan(k)/k, by its pole at k = i kappa and its cut from i to i infinity:
///   4 pi r G(r) = D exp(-kappa r) + int_1^inf w(eta) exp(-eta r) d eta.
class PointSource {
 public:
  explicit PointSource(double albedo) : c_(albedo) {
    double low = 1e-9, high = 1.0 - 1e-15;  // c atanh(kappa) = kappa
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (c_ * std::atanh(middle) < middle ? low : high) = middle;
    }
    kappa_ = low;
    const double slope = 1.0 / (kappa_ * (1.0 - kappa_ * kappa_)) -
                         std::atanh(kappa_) / (kappa_ * kappa_);  // of atanh(kappa)/kappa
    discrete_ = 2.0 * kappa_ / (c_ * c_ * slope);
  }

  /// int_a^b s G(s) ds.
  double first_moment(double a, double b) const {
    const double pole = discrete_ * (std::exp(-kappa_ * a) - std::exp(-kappa_ * b)) / kappa_;
    const double cut =
        integrate_cut([&](double x) { return (std::exp(-a / x) - std::exp(-b / x)) / x; });
    return (pole + cut) / (4.0 * M_PI);
  }

  /// int G dV over all space.
  double total() const {
    // int 4 pi r^2 exp(-k r) / (4 pi r) dr = 1 / k^2
    return discrete_ / (kappa_ * kappa_) + integrate_cut([](double) { return 1.0; });
  }

 private:
  /// int_1^inf w(eta) f(1/eta) eta^-2 d eta, as int_0^1 w f(x) dx.
  template <class F>
  double integrate_cut(F&& f) const {
    return integrate(0.0, 1.0, 40, [&](double s) {
      const double x = s * s * (3.0 - 2.0 * s);  // crowds nodes at both ends
      const double real = 1.0 - c_ * x * std::atanh(x), imaginary = 0.5 * M_PI * c_ * x;
      return 6.0 * s * (1.0 - s) * f(x) / (real * real + imaginary * imaginary);
    });
  }

  double c_, kappa_, discrete_;
};

/// Unscattered fluence at `r` of a sphere of radius `a` that emits radiance 1 outward.
double unscattered(double r, double a) {
  if (r <= a) return 0.0;
  return 2.0 * M_PI * integrate(0.0, std::asin(a / r), 20, [&](double theta) {
           const double sine = r * std::sin(theta);
           const double s = r * std::cos(theta) - std::sqrt(std::max(0.0, a * a - sine * sine));
           return std::sin(theta) * std::exp(-s);
         });
}

/// Fluence at `r`: what is unscattered, and what each first scattering sends out as a point source.
double fluence(double r, double a, double albedo) {
  const PointSource source(albedo);
  const auto integrand = [&](double s) {
    return s * unscattered(s, a) * source.first_moment(std::abs(r - s), r + s);
  };
  // Nodes crowd where the kernel has its logarithm, at s = r, and at the surface of the sphere.
  const auto crowded = [&](double from, double to) {
    return integrate(0.0, 1.0, 40, [&](double u) {
      return 6.0 * u * (1.0 - u) * (to - from) *
             integrand(from + (to - from) * u * u * (3.0 - 2.0 * u));
    });
  };
  const double scattered = crowded(a, r) + crowded(r, r + 2.0) + crowded(r + 2.0, r + 30.0);
  return unscattered(r, a) + albedo * 2.0 * M_PI / r * scattered;
}

TEST(PointSource, ExactSolutionConservesEnergy) {
  // Every photon is absorbed once: (1 - c) int G dV = 1.
  for (const double albedo : {0.2, 0.5, 0.9})
    EXPECT_NEAR(PointSource(albedo).total() * (1.0 - albedo), 1.0, 1e-5) << albedo;
}

struct Place {
  double albedo, r;
};
class PointSourceFluence : public ::testing::TestWithParam<Place> {};

TEST_P(PointSourceFluence, IsThatOfTheExactSolution) {
  const auto [albedo, r] = GetParam();
  constexpr double kRadius = 0.25;
  const std::string scene = scene_text(
      parallel_sensor({0, 0, 0}, {0, 0, 1}, 1.0) +
      homogeneous_text(1.0, albedo, 0.0, R"(id="fog")") + R"(<ref id="fog"/>)" +
      fmt::format(R"(<shape type="sphere"><float name="radius" value="{}"/><bsdf type="null"/>)",
                  kRadius) +
      R"(<ref name="interior" id="fog"/><ref name="exterior" id="fog"/>)"
      R"(<emitter type="area"><float name="radiance" value="1"/></emitter></shape>)");
  const RunningMean L = measure_radiance(
      {.xml = scene, .camera = std::make_shared<const FluenceCamera>(Vec3(0.0f, float(r), 0.0f))});
  expect_law(
      {.name = fmt::format(
           "fluence / 4 pi at {:g} mean free paths from a small sphere, albedo {:g}", r, albedo),
       .source = "exact point kernel, Case and Zweifel 1967, folded with the sphere's light",
       .expected = fluence(r, kRadius, albedo) / (4.0 * M_PI)},
      L.mean(), L.standard_error());
}
INSTANTIATE_TEST_SUITE_P(, PointSourceFluence,
                         ::testing::Values(Place{0.5, 0.5}, Place{0.5, 2.0}, Place{0.9, 0.5},
                                           Place{0.9, 1.0}, Place{0.9, 2.0}));

}  // namespace
}  // namespace brume::test
