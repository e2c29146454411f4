// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "medium/heterogeneous_medium.h"
#include "medium/homogeneous_medium.h"
#include "support/chi_square.h"
#include "support/grids.h"
#include "support/statistics.h"

namespace brume {
namespace {

constexpr int kBins = 60;
constexpr int kFlights = 1000000;

/// Pearson's test that flights end in the bins with the probabilities given; the last bin holds
/// those that pass. Bins with fewer than five expected flights are pooled.
::testing::AssertionResult follow(const std::vector<double>& observed,
                                  const std::vector<double>& probability) {
  const double n = std::accumulate(observed.begin(), observed.end(), 0.0);
  double chi_square = 0.0, pooled_observed = 0.0, pooled_expected = 0.0;
  int terms = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    pooled_observed += observed[i];
    pooled_expected += n * probability[i];
    if (pooled_expected < 5.0) continue;
    chi_square += std::pow(pooled_observed - pooled_expected, 2) / pooled_expected;
    ++terms;
    pooled_observed = pooled_expected = 0.0;
  }
  const double p_value = test::upper_gamma(0.5 * (terms - 1), 0.5 * chi_square);
  if (terms > 2 && p_value > 1e-5) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "chi-square " << chi_square << " with " << terms - 1
                                       << " degrees of freedom, p-value " << p_value;
}

/// How many flights along `ray` scatter in each of kBins equal parts of [0, t_max), and how many
/// do not, last.
std::vector<double> histogram(const Medium& medium, const Ray& ray, float t_max, const Rgb& beta,
                              std::uint64_t seed) {
  std::vector<double> counts(kBins + 1, 0.0);
  for (int i = 0; i < kFlights; ++i) {
    Sampler sampler(seed, 0, std::uint32_t(i), true);
    const FreeFlight flight = medium.sample_free_flight(ray, t_max, beta, sampler);
    EXPECT_TRUE(!flight.scattered || (flight.t >= 0.0f && flight.t < t_max));
    counts[flight.scattered ? std::min(int(flight.t / t_max * kBins), kBins - 1) : kBins] += 1.0;
  }
  return counts;
}

struct HomogeneousCase {
  Rgb sigma_t, beta;
  float t_max;
};

class HomogeneousFreeFlight : public ::testing::TestWithParam<HomogeneousCase> {};

TEST_P(HomogeneousFreeFlight, ScattersWithTheDensityItStates) {
  const auto& [sigma_t, beta, t_max] = GetParam();
  const HomogeneousMedium medium(sigma_t, Rgb(0.9f), {0.2f});
  const Ray ray{{1.0f, 2.0f, 3.0f}, glm::normalize(Vec3(1.0f, -2.0f, 0.5f))};

  // A mixture of one exponential a channel, each chosen in proportion to what the path carries.
  const double total = double(beta.r) + beta.g + beta.b;
  const auto passes = [&](double t) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) sum += beta[c] / total * std::exp(-double(sigma_t[c]) * t);
    return sum;
  };
  std::vector<double> probability;
  for (int i = 0; i < kBins; ++i) {
    const double a = double(t_max) * i / kBins, b = double(t_max) * (i + 1) / kBins;
    probability.push_back(passes(a) - passes(b));
    // The density that the medium states, by Simpson's rule over the bin.
    const auto pdf = [&](double t) {
      return double(medium.scattering_at(ray, float(t), beta)->pdf);
    };
    const double stated = (b - a) / 6.0 * (pdf(a) + 4.0 * pdf(0.5 * (a + b)) + pdf(b));
    EXPECT_NEAR(stated, probability.back(), 1e-3 * probability.back() + 1e-9) << "bin " << i;
  }
  probability.push_back(passes(t_max));
  EXPECT_TRUE(follow(histogram(medium, ray, t_max, beta, 31), probability));
}

INSTANTIATE_TEST_SUITE_P(
    Cases, HomogeneousFreeFlight,
    ::testing::Values(HomogeneousCase{Rgb(1.0f), Rgb(1.0f), 3.0f},
                      HomogeneousCase{Rgb(1e-3f), Rgb(1.0f), 2000.0f},
                      HomogeneousCase{Rgb(500.0f), Rgb(0.3f), 0.02f},
                      HomogeneousCase{Rgb(0.3f, 1.0f, 4.0f), Rgb(1.0f), 2.0f},
                      HomogeneousCase{Rgb(0.3f, 1.0f, 4.0f), Rgb(0.1f, 0.0f, 2.0f), 2.0f},
                      HomogeneousCase{Rgb(2.0f, 0.0f, 1.0f), Rgb(1.0f, 1.0f, 0.5f), 4.0f}));

/// A ray through the grid and the optical thickness along it, at the ends of the bins and in finer
/// steps between.
class OpticalThickness {
 public:
  static constexpr int kStepsPerBin = 400;

  template <class Value>
  OpticalThickness(const Grid<Value>& grid, const Ray& ray, float t_max, double scale,
                   int channel) {
    GridLookup<Value> lookup(grid);
    const double step = double(t_max) / (kBins * kStepsPerBin);
    const glm::dvec3 o(ray.o), d(ray.d);
    double tau = 0.0;
    for (int i = 0; i < kBins; ++i) {
      ends_.push_back(tau);
      for (int j = 0; j < kStepsPerBin; ++j) {
        const double t = (i * kStepsPerBin + j + 0.5) * step;
        const glm::dvec3 p(grid.index_from_world() * glm::dvec4(o + t * d, 1.0));
        const Vec3 index(p);
        const bool inside = glm::all(glm::greaterThanEqual(index, grid.box().min)) &&
                            glm::all(glm::lessThanEqual(index, grid.box().max));
        if (inside) tau += scale * step * component(lookup.trilinear(index), channel);
      }
    }
    ends_.push_back(tau);
  }

  /// Probability of a collision in each bin, and of none, last.
  std::vector<double> probabilities() const {
    std::vector<double> result;
    for (int i = 0; i < kBins; ++i)
      result.push_back(-std::exp(-ends_[i]) * std::expm1(ends_[i] - ends_[i + 1]));
    result.push_back(std::exp(-ends_.back()));
    return result;
  }

 private:
  static double component(float v, int) { return v; }
  static double component(const Rgb& v, int channel) { return v[channel]; }

  std::vector<double> ends_;  // [bin + 1]
};

glm::dmat4 turned() {
  glm::dmat4 m = glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(1.0, -2.0, 0.7)));
  return glm::scale(m, glm::dvec3(-1.5, 2.0, 1.1));
}

struct GridCase {
  const char* name;
  glm::ivec3 n;
  float scale;
  std::function<float(int, int, int)> density;
};
void PrintTo(const GridCase& c, std::ostream* out) {
  *out << c.name;
}

class HeterogeneousFreeFlight : public ::testing::TestWithParam<GridCase> {};

TEST_P(HeterogeneousFreeFlight, ScattersWithExtinctionTimesTransmittance) {
  const GridCase& c = GetParam();
  const auto grid = test::make_grid(c.n, c.density, turned());
  const auto medium =
      make_heterogeneous_medium(grid, c.scale, std::make_shared<ConstantField>(Rgb(0.9f)), {0.2f});
  const Vec3 centre(turned() * glm::dvec4(0.45, 0.55, 0.5, 1.0));
  for (const Vec3& direction : {Vec3(1.0f, 0.2f, 0.3f), Vec3(-0.2f, -1.0f, 0.4f)}) {
    const Ray ray{centre - 1.3f * glm::normalize(direction), glm::normalize(direction)};
    const float t_max = 2.5f;
    EXPECT_TRUE(follow(histogram(*medium, ray, t_max, Rgb(1.0f), 37),
                       OpticalThickness(*grid, ray, t_max, c.scale, 0).probabilities()));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Grids, HeterogeneousFreeFlight,
    ::testing::Values(
        GridCase{"constant", {6, 5, 7}, 1.0f, [](int, int, int) { return 1.2f; }},
        GridCase{"ramp", {20, 9, 9}, 0.5f, [](int x, int, int) { return 0.2f * float(x); }},
        GridCase{"noise",
                 {14, 13, 12},
                 2.0f,
                 [](int x, int y, int z) { return float((x * 7 + y * 5 + z * 3) % 11) / 11.0f; }},
        GridCase{"blocks",
                 {16, 16, 16},
                 4.0f,
                 [](int x, int y, int z) { return (x / 4 + y / 4 + z / 4) % 2 ? 1.5f : 0.0f; }},
        GridCase{
            "sheet", {24, 24, 24}, 1.0f, [](int x, int, int) { return x == 12 ? 30.0f : 0.05f; }}),
    [](const ::testing::TestParamInfo<GridCase>& c) { return c.param.name; });

TEST(ColouredFreeFlight, WeightsFollowTheDensityOfEveryChannel) {
  constexpr int n = 9;
  nanovdb::GridBuilder<nanovdb::Vec3f> builder(nanovdb::Vec3f(0.0f));
  auto accessor = builder.getAccessor();
  for (int z = -1; z <= n; ++z)
    for (int y = -1; y <= n; ++y)
      for (int x = -1; x <= n; ++x) {
        const int a = std::clamp(x, 0, n - 1), b = std::clamp(y, 0, n - 1);
        accessor.setValue(nanovdb::Coord(x, y, z),
                          nanovdb::Vec3f(0.3f * float(a), 2.0f, 0.4f * float((a + b) % 5)));
      }
  glm::dmat4 world_from_index = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / n));
  world_from_index = glm::translate(world_from_index, glm::dvec3(0.5));
  const auto grid = std::make_shared<const Grid<Rgb>>(builder.getHandle<>(), world_from_index,
                                                      Box3{Vec3(-0.5f), Vec3(float(n) - 0.5f)},
                                                      Interpolation::kTrilinear, Wrap::kClamp);
  const Rgb albedo(1.0f, 0.8f, 0.6f);
  const auto medium =
      make_heterogeneous_medium(grid, 1.0f, std::make_shared<ConstantField>(albedo), {});
  const Ray ray{{-0.2f, 0.15f, 0.3f}, glm::normalize(Vec3(1.0f, 0.6f, 0.2f))};
  const float t_max = 1.5f;

  for (const Rgb& beta : {Rgb(1.0f), Rgb(1.0f, 0.0f, 0.2f)}) {
    std::vector<std::array<test::RunningMean, 3>> weights(kBins + 1);
    for (int i = 0; i < kFlights / 8; ++i) {
      Sampler sampler(41, 0, std::uint32_t(i), true);
      const FreeFlight flight = medium->sample_free_flight(ray, t_max, beta, sampler);
      const int bin = flight.scattered ? std::min(int(flight.t / t_max * kBins), kBins - 1) : kBins;
      for (int b = 0; b <= kBins; ++b)
        for (int c = 0; c < 3; ++c) weights[b][c].add(b == bin ? flight.weight[c] : 0.0f);
    }
    for (int c = 0; c < 3; ++c) {
      // What a path carries nothing of may have any weight.
      if (beta[c] == 0.0f) continue;
      const std::vector<double> probability =
          OpticalThickness(*grid, ray, t_max, 1.0, c).probabilities();
      for (int b = 0; b <= kBins; ++b)
        EXPECT_TRUE(test::agrees(weights[b][c], probability[b] * (b < kBins ? albedo[c] : 1.0f),
                                 1e-4 / kBins))
            << "channel " << c << ", bin " << b;
    }
  }
}

}  // namespace
}  // namespace brume
