// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "statistics/cameras.h"
#include "statistics/measure.h"
#include "statistics/scene_text.h"
#include "statistics/slab_table.h"

namespace brume::test {
namespace {

/// Reflectance and transmittance of one slab under a half-lit sky: by reciprocity, a view at
/// cosine mu from above shows R(mu) of a beam at mu in the light from above, and T(mu) in the
/// light from below.
void expect_slab(const SlabReference& slab, const std::string& view,
                 const std::shared_ptr<const Camera>& camera, double R, double T) {
  const double relative_error = slab.tau > 16.0 ? 0.005 : 0.002;
  const std::string medium = homogeneous_text(slab.tau, slab.albedo, slab.g);
  const std::string sensor = sensor_at_cosine(1.0);
  const Experiment experiment{.xml = scene_text(sensor + slab_text(medium) + kHalfLitSky),
                              .camera = camera,
                              .write_files = write_half_lit_sky};
  // Fewer than one path in fifty would take hours to count to these digits.
  constexpr double kRare = 0.02;
  const bool R_is_seen = R >= kRare, T_is_seen = T >= kRare;
  if (!R_is_seen && !T_is_seen) GTEST_SKIP() << "hardly any light comes back or through";
  const auto means = measure(
      experiment,
      [&](const CameraSample& s) {
        return std::vector<double>{R_is_seen ? s.L.r : 0.0, T_is_seen ? s.L.g : 0.0};
      },
      relative_error);
  const auto name = [&](const char* what) {
    return fmt::format("{} of a slab, {}, g {:g}, albedo {:g}, tau {:g}", what, view, slab.g,
                       slab.albedo, slab.tau);
  };
  const std::string source = "adding-doubling, `reference_slabs.py`";
  const auto check = [&](const char* what, double expected, const RunningMean& m) {
    expect_law({.name = name(what),
                .source = source,
                .expected = expected,
                .max_relative_error = relative_error},
               m.mean(), m.standard_error());
  };
  if (R_is_seen) check("R", R, means[0]);
  if (T_is_seen) check("T", T, means[1]);
}

/// What every run tests; the long version tests all.
constexpr std::array<double, 3> kQuick[] = {
    // g, albedo, tau
    {-0.8, 0.2, 0.5}, {-0.8, 0.5, 2}, {-0.8, 1, 2},    {-0.8, 0.9, 64}, {0, 0.2, 2},
    {0, 0.5, 0.5},    {0, 0.9, 2},    {0, 1, 0.1},     {0, 1, 2},       {0, 0.9, 64},
    {0.5, 0.9, 2},    {0.5, 1, 8},    {0.5, 0.9, 64},  {0.75, 0.9, 2},  {0.75, 1, 2},
    {0.75, 1, 8},     {0.75, 1, 32},  {0.75, 0.9, 64}, {0.95, 1, 8}};

}  // namespace

void PrintTo(const SlabReference& s, std::ostream* stream) {
  *stream << "g " << s.g << ", albedo " << s.albedo << ", tau " << s.tau;
}

namespace {

class Slab : public ::testing::TestWithParam<SlabReference> {
 protected:
  void SetUp() override {
    const SlabReference& s = GetParam();
    const std::array<double, 3> key{s.g, s.albedo, s.tau};
    if (!runs_long_version() &&
        std::find(std::begin(kQuick), std::end(kQuick), key) == std::end(kQuick))
      GTEST_SKIP() << "part of the long version";
  }
};

TEST_P(Slab, NormalIncidence) {
  const SlabReference& slab = GetParam();
  expect_slab(slab, "normal incidence", nullptr, slab.R_normal, slab.T_normal);
}

TEST_P(Slab, DiffuseLight) {
  const SlabReference& slab = GetParam();
  const auto camera =
      std::make_shared<const IrradianceCamera>(Vec3(0.0f, 0.501f, 0.0f), Vec3(0.0f, -1.0f, 0.0f));
  expect_slab(slab, "diffuse light", camera, slab.R_diffuse, slab.T_diffuse);
}

std::string name_of(const ::testing::TestParamInfo<SlabReference>& info) {
  const SlabReference& s = info.param;
  std::string name = fmt::format("g_{:g}_albedo_{:g}_tau_{:g}", s.g, s.albedo, s.tau);
  std::replace(name.begin(), name.end(), '-', 'm');
  std::replace(name.begin(), name.end(), '.', 'p');
  return name;
}

INSTANTIATE_TEST_SUITE_P(, Slab, ::testing::ValuesIn(kSlabs), name_of);

}  // namespace
}  // namespace brume::test
