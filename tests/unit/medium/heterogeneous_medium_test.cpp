// SPDX-License-Identifier: Apache-2.0
#include "medium/heterogeneous_medium.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "medium/majorant_check.h"
#include "support/grids.h"
#include "support/statistics.h"

namespace brume {
namespace {

struct FieldCase {
  const char* name;
  glm::ivec3 n;
  std::function<float(int, int, int)> density;
};

const std::vector<FieldCase>& fields() {
  static const std::vector<FieldCase> cases = {
      {"constant", {9, 9, 9}, [](int, int, int) { return 2.0f; }},
      {"ramp", {16, 8, 8}, [](int x, int, int) { return 0.25f * float(x); }},
      {"checkerboard",
       {12, 12, 12},
       [](int x, int y, int z) { return (x + y + z) % 2 ? 6.0f : 0.0f; }},
      {"blocks",
       {16, 16, 16},
       [](int x, int y, int z) { return (x / 4 + y / 4 + z / 4) % 2 ? 8.0f : 0.0f; }},
      {"one voxel", {1, 1, 1}, [](int, int, int) { return 3.0f; }},
      {"lonely voxel",
       {11, 11, 11},
       [](int x, int y, int z) { return x == 5 && y == 5 && z == 5 ? 40.0f : 0.0f; }},
      {"haze before a wall", {13, 13, 13}, [](int x, int, int) { return x < 8 ? 0.4f : 1e6f; }},
  };
  return cases;
}

glm::dmat4 skewed_transform() {
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -2.0, 1.0));
  m = glm::rotate(m, 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
  return glm::scale(m, glm::dvec3(2.0, -0.7, 1.3));
}

/// Optical thickness by the midpoint rule between the faces of the box, in double.
double quadrature(const Grid<float>& grid, const Ray& ray, double t_max) {
  const glm::dvec3 o(grid.index_from_world() * glm::dvec4(ray.o, 1.0));
  const glm::dvec3 d(glm::dmat3(grid.index_from_world()) * glm::dvec3(ray.d));
  const glm::dvec3 a = (glm::dvec3(grid.box().min) - o) / d;
  const glm::dvec3 b = (glm::dvec3(grid.box().max) - o) / d;
  const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
  const double t0 = std::max({0.0, near.x, near.y, near.z});
  const double t1 = std::min({t_max, far.x, far.y, far.z});

  GridLookup<float> lookup(grid);
  const int n = 20000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    sum += lookup.trilinear(Vec3(o + (t0 + (i + 0.5) / n * (t1 - t0)) * d));
  return sum * (t1 - t0) / n;
}

class HeterogeneousLaw : public ::testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(HeterogeneousLaw, TransmittanceAndFlightsFollowTheOpticalThickness) {
  const auto [index, transformed] = GetParam();
  const FieldCase& field = fields()[index];
  SCOPED_TRACE(field.name);
  const glm::dmat4 to_world = transformed ? skewed_transform() : glm::dmat4(1.0);
  const auto grid = test::make_grid(field.n, field.density, to_world);
  const float scale = 0.8f;
  const auto medium = make_heterogeneous_medium(
      grid, scale, std::make_shared<ConstantField>(Rgb(0.5f, 0.7f, 0.9f)), {0.3f});

  const Vec3 centre(to_world * glm::dvec4(0.5, 0.5, 0.5, 1.0));
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-0.3f, 0.8f, 0.4f), Vec3(0.1f, -0.2f, -1.0f)}) {
    const Vec3 d = glm::normalize(direction);
    const Ray ray{centre - 4.0f * d, d};
    const float t_max = 4.3f;  // ends inside
    const double T = std::exp(-scale * quadrature(*grid, ray, t_max));
    const double T_half = std::exp(-scale * quadrature(*grid, ray, 4.0f));
    test::RunningMean estimate, passed, passed_half;
    Rng rng(17);
    for (int i = 0; i < 100000; ++i) {
      estimate.add(medium->transmittance(ray, t_max, rng).r);
      Sampler sampler(19, 0, i, true);
      const FreeFlight flight = medium->sample_free_flight(ray, t_max, Rgb(1.0f), sampler);
      passed.add(!flight.scattered);
      passed_half.add(!flight.scattered || flight.t > 4.0f);
      if (flight.scattered) {
        ASSERT_EQ(flight.weight, Rgb(0.5f, 0.7f, 0.9f));
      }
    }
    EXPECT_TRUE(test::agrees(estimate, T, 2e-5));
    EXPECT_TRUE(test::agrees(passed, T, 2e-5));
    EXPECT_TRUE(test::agrees(passed_half, T_half, 2e-5));
  }
#ifdef BRUME_COUNT_VIOLATIONS
  EXPECT_EQ(majorant_violations(), 0u);
#endif
}

INSTANTIATE_TEST_SUITE_P(Fields, HeterogeneousLaw,
                         ::testing::Combine(::testing::Range(0, 7), ::testing::Bool()));

TEST(HeterogeneousMedium, EmptyPlacesBesideOnesThickBeyondMeasureArePassed) {
  const auto grid = test::make_grid(
      {9, 9, 9}, [](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? 1.0f : 0.0f; });
  const auto medium =
      make_heterogeneous_medium(grid, 1e30f, std::make_shared<ConstantField>(Rgb(1.0f)), {});
  Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const float beside = (4.5f + 1.2f + 0.3f * rng.next_float()) / 9.0f;
    const float within = (4.5f + 0.3f * rng.next_float()) / 9.0f;
    for (const auto& [y, T] : {std::pair(beside, 1.0f), std::pair(within, 0.0f)}) {
      const Ray ray{{-1.0f, y, 0.5f}, {1.0f, 0.0f, 0.0f}};
      EXPECT_EQ(medium->transmittance(ray, kInfinity, rng).r, T);
      Sampler sampler(19, 0, i, true);
      EXPECT_EQ(medium->sample_free_flight(ray, kInfinity, Rgb(1.0f), sampler).scattered,
                T == 0.0f);
    }
  }
}

TEST(HeterogeneousMedium, FlightsFromTheOriginOfTheGridGetOnWhereItIsThickBeyondMeasure) {
  // Near the origin points are finer than the rounding of the way that was come.
  const auto grid = test::make_grid(
      {9, 9, 9}, [](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? 1.0f : 0.0f; });
  const auto medium =
      make_heterogeneous_medium(grid, 1e30f, std::make_shared<ConstantField>(Rgb(1.0f)), {});
  const Ray ray{Vec3(0.0f), glm::normalize(Vec3(1.0f))};
  Rng rng(1);
  Sampler sampler(19, 0, 0, true);
  EXPECT_EQ(medium->transmittance(ray, kInfinity, rng).r, 0.0f);
  EXPECT_TRUE(medium->sample_free_flight(ray, kInfinity, Rgb(1.0f), sampler).scattered);
}

TEST(HeterogeneousMedium, EverySettingHasTheSameExpectation) {
  using Bounds = TrackingSettings::Bounds;
  using Lookup = TrackingSettings::Lookup;
  const FieldCase& field = fields()[3];
  const auto grid = test::make_grid(field.n, field.density, skewed_transform());
  const Vec3 centre(skewed_transform() * glm::dvec4(0.5, 0.5, 0.5, 1.0));
  const Vec3 d = glm::normalize(Vec3(-0.3f, 0.8f, 0.4f));
  const Ray ray{centre - 4.0f * d, d};
  const double T = std::exp(-0.2 * quadrature(*grid, ray, 4.3f));
  ASSERT_GT(T, 0.05);
  ASSERT_LT(T, 0.95);
  for (const Bounds bounds : {Bounds::kCells, Bounds::kGlobal})
    for (const Lookup lookup : {Lookup::kStochastic, Lookup::kTrilinear})
      for (const bool control : {true, false}) {
        const auto medium = make_heterogeneous_medium(
            grid, 0.2f, std::make_shared<ConstantField>(Rgb(1.0f)), {},
            {.bounds = bounds, .lookup = lookup, .control = control, .roulette = control});
        test::RunningMean estimate, passed;
        Rng rng(17);
        for (int i = 0; i < 100000; ++i) {
          estimate.add(medium->transmittance(ray, 4.3f, rng).r);
          Sampler sampler(19, 0, i, true);
          passed.add(!medium->sample_free_flight(ray, 4.3f, Rgb(1.0f), sampler).scattered);
        }
        EXPECT_TRUE(test::agrees(estimate, T, 2e-5));
        EXPECT_TRUE(test::agrees(passed, T, 2e-5));
      }
}

TEST(HeterogeneousMedium, MissesWhatIsOutsideItsBox) {
  const auto grid = test::make_grid({4, 4, 4}, [](int, int, int) { return 1e6f; });
  const auto medium =
      make_heterogeneous_medium(grid, 1.0f, std::make_shared<ConstantField>(Rgb(1.0f)), {});
  Rng rng(1);
  Sampler sampler(1, 0, 0);
  EXPECT_EQ(medium->transmittance({{-1, 2, 0.5f}, {1, 0, 0}}, kInfinity, rng), Rgb(1.0f));
  EXPECT_EQ(medium->transmittance({{-1, 0.5f, 0.5f}, {1, 0, 0}}, 0.99f, rng), Rgb(1.0f));
  const FreeFlight flight =
      medium->sample_free_flight({{-1, 0.5f, 0.5f}, {1, 0, 0}}, kInfinity, Rgb(1.0f), sampler);
  EXPECT_TRUE(flight.scattered);
  EXPECT_NEAR(flight.t, 1.0f, 1e-4f);
}

/// Grid whose extinction differs by channel; unit cube of `n`^3 constant voxels.
std::shared_ptr<const Grid<Rgb>> colored_cube(int n, const Rgb& value) {
  nanovdb::GridBuilder<nanovdb::Vec3f> builder(nanovdb::Vec3f(0.0f));
  auto accessor = builder.getAccessor();
  for (int z = -1; z <= n; ++z)
    for (int y = -1; y <= n; ++y)
      for (int x = -1; x <= n; ++x)
        accessor.setValue(nanovdb::Coord(x, y, z), nanovdb::Vec3f(value.r, value.g, value.b));
  glm::dmat4 m = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / n));
  m = glm::translate(m, glm::dvec3(0.5));
  return std::make_shared<const Grid<Rgb>>(builder.getHandle<>(), m,
                                           Box3{Vec3(-0.5f), Vec3(float(n) - 0.5f)},
                                           Interpolation::kTrilinear, Wrap::kClamp);
}

TEST(HeterogeneousMedium, ColoredExtinctionIsUnbiasedInEveryChannel) {
  const Rgb sigma_t(0.3f, 1.0f, 3.0f);
  const auto medium = make_heterogeneous_medium(
      colored_cube(5, sigma_t), 1.0f, std::make_shared<ConstantField>(Rgb(1.0f, 0.8f, 0.6f)), {});
  const Ray ray{{-1, 0.5f, 0.5f}, {1, 0, 0}};
  test::RunningMean T[3], scattered[3];
  Rng rng(23);
  const Rgb beta(1.0f, 0.2f, 0.7f);
  for (int i = 0; i < 200000; ++i) {
    const Rgb estimate = medium->transmittance(ray, kInfinity, rng);
    Sampler sampler(29, 0, i, true);
    const FreeFlight flight = medium->sample_free_flight(ray, kInfinity, beta, sampler);
    for (int k = 0; k < 3; ++k) {
      T[k].add(estimate[k]);
      scattered[k].add(flight.scattered ? flight.weight[k] : 0.0f);
      ASSERT_LE(beta[k] * flight.weight[k], 1.9001f);  // never above the sum of beta
    }
  }
  const Rgb albedo(1.0f, 0.8f, 0.6f);
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(test::agrees(T[k], std::exp(-double(sigma_t[k])), 1e-6));
    EXPECT_TRUE(
        test::agrees(scattered[k], albedo[k] * (1.0 - std::exp(-double(sigma_t[k]))), 1e-6));
  }
}

TEST(HeterogeneousMedium, PackedVoxelsPassNearlyTheSameLight) {
  const Ray ray{.o = {0.31f, 0.42f, -1.0f}, .d = {0.0f, 0.0f, 1.0f}};
  for (const FieldCase& field : fields()) {
    const auto grid = test::make_grid(field.n, field.density);
    const double tau = quadrature(*grid, ray, 5.0);
    for (const auto storage :
         {TrackingSettings::Storage::k16Bit, TrackingSettings::Storage::k8Bit}) {
      const auto medium =
          make_heterogeneous_medium(grid, 1.0f, std::make_shared<ConstantField>(Rgb(0.5f)),
                                    HenyeyGreenstein{.g = 0.0f}, {.storage = storage});
      test::RunningMean T;
      Rng rng(1);
      for (int i = 0; i < 20000; ++i) T.add(medium->transmittance(ray, 5.0f, rng).g);
      // A step of a block is a 255th of its largest value, 40, along a path of one unit.
      const double rounding = storage == TrackingSettings::Storage::k8Bit ? 0.08 : 1e-3;
      EXPECT_TRUE(test::agrees(T, std::exp(-tau), rounding)) << field.name;
    }
  }
  EXPECT_EQ(majorant_violations(), 0u);
}

}  // namespace
}  // namespace brume
