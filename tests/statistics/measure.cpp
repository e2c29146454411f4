// SPDX-License-Identifier: Apache-2.0
#include "statistics/measure.h"

#include <cstdlib>

#include "core/hash.h"
#include "support/render_scene.h"

namespace brume::test {
namespace {

/// Experiments with different scenes share no random numbers.
std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  for (const char c : text) seed = hash_combine(seed, std::uint64_t(c));
  return seed;
}

/// Means over replications of `Sampler::kReplication` samples, which are independent of each other
/// where single samples are not.
std::vector<RunningMean> run(const TestScene& scene, const PathIntegrator& integrator,
                             const Tally& tally, std::uint64_t seed, std::int64_t replications) {
  std::vector<RunningMean> means;
  std::int64_t bad = 0;
  for (std::int64_t r = 0; r < replications; ++r) {
    std::vector<double> sums;
    for (std::uint32_t i = 0; i < Sampler::kReplication; ++i) {
      // A sample index has 32 bits; what is beyond goes on in another pixel.
      const std::uint64_t index = std::uint64_t(r) * Sampler::kReplication + i;
      Sampler sampler(seed, std::uint32_t(index >> 32), std::uint32_t(index));
      const CameraSample s = integrator.sample(scene.film_point(0, 0, sampler), sampler);
      bad += !is_finite_and_non_negative(s.L) || !std::isfinite(s.alpha);
      const std::vector<double> values = tally(s);
      sums.resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) sums[k] += values[k];
    }
    means.resize(sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k) means[k].add(sums[k] / Sampler::kReplication);
  }
  EXPECT_EQ(bad, 0) << "samples are infinite, negative or not numbers";
  EXPECT_EQ(majorant_violations(), 0u);
  return means;
}

}  // namespace

std::vector<RunningMean> measure(const Experiment& experiment, const Tally& tally,
                                 double relative_error) {
  const TestScene scene(experiment.xml, experiment.write_files);
  const LoadedScene& loaded = scene.loaded();
  const Camera& camera = experiment.camera ? *experiment.camera : *loaded.camera;
  const PathIntegrator integrator(*loaded.scene, camera, loaded.path);

  // The first pilot is too short for rare events, a sixteenth of the replications is not.
  constexpr double kAim = 0.85;
  constexpr double kShortest = 1 << 8;
  const std::uint64_t seed = seed_of(experiment.xml);
  double replications = kShortest;
  for (std::uint64_t pilot = 0; pilot < 2; ++pilot) {
    double needed = kShortest;
    for (const RunningMean& m :
         run(scene, integrator, tally, seed + 1 + pilot, std::int64_t(replications))) {
      const double sigma = m.standard_error() * std::sqrt(double(m.count()));
      const double target = kAim * relative_error * std::abs(m.mean());
      if (target > 0.0) needed = std::max(needed, sigma * sigma / (target * target));
    }
    replications = pilot == 0 ? std::max(needed / 16.0, kShortest) : needed;
  }
  return run(scene, integrator, tally, seed, std::int64_t(replications));
}

RunningMean measure_radiance(const Experiment& experiment, double relative_error) {
  return measure(
      experiment, [](const CameraSample& s) { return std::vector<double>{mean(s.L)}; },
      relative_error)[0];
}

bool runs_long_version() {
  return std::getenv("BRUME_LONG") != nullptr;
}

}  // namespace brume::test
