// SPDX-License-Identifier: Apache-2.0
#include "film/filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <ostream>

#include "core/rng.h"
#include "support/statistics.h"

namespace brume {
namespace {

struct FilterCase {
  const char* name;
  std::shared_ptr<const Filter> filter;
  float radius;                         // [pixel]
  std::function<double(double)> shape;  // along one axis, not normalised

  friend std::ostream& operator<<(std::ostream& out, const FilterCase& c) { return out << c.name; }
};

double lowered_gaussian(double x, double stddev) {
  return std::exp(-0.5 * x * x / (stddev * stddev)) - std::exp(-8.0);
}

class FilterLaw : public ::testing::TestWithParam<FilterCase> {};

/// Integral of `f` over [a, b] by the midpoint rule.
double integrate(const std::function<double(double)>& f, double a, double b) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += f(a + (b - a) * (i + 0.5) / kSteps);
  return sum * (b - a) / kSteps;
}

TEST_P(FilterLaw, SamplesHaveTheShapeOfTheFilter) {
  const auto& [name, filter, radius, shape] = GetParam();
  constexpr int kSamples = 200000;
  constexpr int kBins = 12;  // an axis
  std::array<std::array<int, kBins>, kBins> counts{};
  const double r = radius;
  Rng rng(7);
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 offset = filter->sample(rng.next_vec2());
    ASSERT_LE(std::max(std::abs(offset.x), std::abs(offset.y)), radius);
    const auto bin = [r](float x) {
      return std::size_t(std::min(kBins - 1, int(kBins * (x + r) / (2.0 * r))));
    };
    counts[bin(offset.y)][bin(offset.x)] += 1;
  }

  std::array<double, kBins> mass;
  const double total = integrate(shape, -r, 0.0) + integrate(shape, 0.0, r);
  for (int i = 0; i < kBins; ++i)
    mass[std::size_t(i)] =
        integrate(shape, r * (2.0 * i / kBins - 1.0), r * (2.0 * (i + 1) / kBins - 1.0)) / total;

  // Bins that expect fewer than 5 samples are pooled.
  double chi_square = 0.0, pooled_expected = 0.0, pooled_count = 0.0;
  int degrees = -1;
  const auto add = [&](double count, double expected) {
    chi_square += (count - expected) * (count - expected) / expected;
    degrees += 1;
  };
  for (std::size_t y = 0; y < kBins; ++y) {
    for (std::size_t x = 0; x < kBins; ++x) {
      const double expected = kSamples * mass[x] * mass[y];
      if (expected >= 5.0) {
        add(counts[y][x], expected);
      } else {
        pooled_expected += expected;
        pooled_count += counts[y][x];
      }
    }
  }
  if (pooled_expected > 0.0) add(pooled_count, pooled_expected);
  // Wilson and Hilferty 1931: the cube root of chi-square over its degrees is nearly normal.
  const double spread = 2.0 / (9.0 * degrees);
  const double z = (std::cbrt(chi_square / degrees) - (1.0 - spread)) / std::sqrt(spread);
  EXPECT_LT(z, test::kMaxZ) << name << ": chi-square " << chi_square << " with " << degrees;
}

TEST_P(FilterLaw, MeanIsTheCentreAndVarianceTheAnalyticOne) {
  const auto& [name, filter, radius, shape] = GetParam();
  const double r = radius;
  const auto moment = [&](const auto& f) { return integrate(f, -r, 0.0) + integrate(f, 0.0, r); };
  const auto& f = shape;
  const double variance = moment([&f](double x) { return x * x * f(x); }) / moment(f);
  Rng rng(8);
  test::RunningMean x, xx, xy;
  for (int i = 0; i < 100000; ++i) {
    const Vec2 offset = filter->sample(rng.next_vec2());
    x.add(offset.x);
    xx.add(offset.y * offset.y);
    xy.add(offset.x * offset.y);
  }
  EXPECT_TRUE(test::agrees(x, 0.0)) << name;
  EXPECT_TRUE(test::agrees(xx, variance)) << name;
  EXPECT_TRUE(test::agrees(xy, 0.0)) << name;
}

TEST_P(FilterLaw, ExtremesOfTheUnitSquareStayInTheSupport) {
  const auto& [name, filter, radius, shape] = GetParam();
  for (const float u : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon}) {
    const float x = filter->sample({u, 0.5f}).x;
    EXPECT_TRUE(std::abs(x) <= radius) << name << ": " << x;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Filters, FilterLaw,
    ::testing::Values(FilterCase{"box", std::make_shared<BoxFilter>(), 0.5f,
                                 [](double) { return 1.0; }},
                      FilterCase{"tent", std::make_shared<TentFilter>(), 1.0f,
                                 [](double x) { return 1.0 - std::abs(x); }},
                      FilterCase{"wide tent", std::make_shared<TentFilter>(2.5f), 2.5f,
                                 [](double x) { return 2.5 - std::abs(x); }},
                      FilterCase{"gaussian", std::make_shared<GaussianFilter>(), 2.0f,
                                 [](double x) { return lowered_gaussian(x, 0.5); }},
                      FilterCase{"wide gaussian", std::make_shared<GaussianFilter>(1.5f), 6.0f,
                                 [](double x) { return lowered_gaussian(x, 1.5); }}),
    [](const auto& test) {
      std::string name = test.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

}  // namespace
}  // namespace brume
