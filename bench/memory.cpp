// SPDX-License-Identifier: Apache-2.0
// How much of tracking is waiting for memory that any renderer would have to wait for: flights
// through a cloud larger than the caches, against a loop that only reads the same cells and voxels
// in the same order.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/warp.h"
#include "medium/heterogeneous_medium.h"
#include "unit_cube_grid.h"
#include "volume/bounds_grid.h"
#include "volume/voxel_blocks.h"

namespace brume {
namespace {

constexpr int kVoxels = 512;       // along each side
constexpr float kExtinction = 60;  // per density and side of the cube; 160 through the middle
constexpr std::size_t kFlights = 1 << 17;
constexpr int kFlightsOfPath = 64;  // at most

/// Sines of mixed frequencies, the cloud of scripts/measure.py.
std::array<float, kVoxels> waves(double stretch, double shift) {
  std::array<float, kVoxels> result{};
  for (int i = 0; i < kVoxels; ++i)
    for (const double k : {3.0, 7.0, 17.0, 41.0})
      result[i] += float(std::sin(stretch * k * (2.0 * (i + 0.5) / kVoxels - 1.0) + shift) / k);
  return result;
}

/// A ball in the unit cube, 0 outside.
std::shared_ptr<const Grid<float>> cloud() {
  static const auto grid = [] {
    const auto x_waves = waves(1.0, 0.3), y_waves = waves(1.1, 1.7), z_waves = waves(0.9, 4.1);
    return unit_cube_grid(kVoxels, [&](const glm::ivec3& v) {
      const float inside = 1.0f - length_squared((Vec3(v) + 0.5f) * (2.0f / kVoxels) - 1.0f);
      const float wave = x_waves[v.x] * y_waves[v.y] * z_waves[v.z];
      return inside > 0.0f ? 2.0f * inside + 0.8f * wave : 0.0f;
    });
  }();
  return grid;
}

/// What flights read, in order: the bounds of cells, and voxels.
struct Reads {
  std::vector<Ray> rays;  // one a flight
  std::vector<glm::ivec3> places;
  std::vector<char> is_voxel;  // or a cell
  std::size_t cells = 0, voxels = 0;
};

/// Paths that scatter forward through the cloud until they leave it. The tracking is that of
/// HeterogeneousMedium, without what flights return.
Reads follow_paths(const BoundsGrid& bounds, const VoxelBlocks<float>& voxels) {
  Reads reads;
  Rng rng(8);
  const HenyeyGreenstein phase{0.8f};
  while (reads.rays.size() < kFlights) {
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    Ray ray{.o = Vec3(0.5f) - 0.5f * d, .d = phase.sample(d, rng.next_vec2()).d};
    for (int flight = 0; flight < kFlightsOfPath; ++flight) {
      const auto segment = clip_to_grid(ray, kInfinity, bounds, cloud()->index_from_world());
      if (!segment) break;
      reads.rays.push_back(ray);
      float tau = -std::log(1.0f - rng.next_float());
      float t_scattered = kInfinity;
      walk_cells(bounds, *segment, [&](const glm::ivec3& cell, float t, float t1) {
        const ValueRange& range = bounds.range(cell);
        reads.places.push_back(cell);
        reads.is_voxel.push_back(false);
        const float sigma_maj = kExtinction * range.max;
        while (tau < sigma_maj * (t1 - t)) {
          t += tau / sigma_maj;
          tau = -std::log(1.0f - rng.next_float());
          const float u = rng.next_float() * range.max;
          if (u < range.min) {
            t_scattered = t;
            return false;
          }
          const glm::ivec3 i(glm::floor(segment->o + t * segment->d + rng.next_float()));
          reads.places.push_back(i);
          reads.is_voxel.push_back(true);
          if (u < voxels(i)) {
            t_scattered = t;
            return false;
          }
        }
        tau -= sigma_maj * (t1 - t);
        return true;
      });
      if (!(t_scattered < kInfinity)) break;
      ray.o = ray.at(segment->t_start + t_scattered);
      ray.d = phase.sample(ray.d, rng.next_vec2()).d;
    }
  }
  for (const char v : reads.is_voxel) ++(v ? reads.voxels : reads.cells);
  return reads;
}

struct Recorded {
  BoundsGrid bounds{*cloud()};
  VoxelBlocks<float> voxels{*cloud()};
  Reads reads = follow_paths(bounds, voxels);
};

const Recorded& recorded() {
  static const Recorded paths;
  return paths;
}

void count(benchmark::State& state) {
  const Reads& reads = recorded().reads;
  const double flights = double(reads.rays.size());
  state.SetItemsProcessed(std::int64_t(flights) * state.iterations());
  state.counters["ns_per_flight"] = benchmark::Counter(
      flights * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["cells"] = double(reads.cells) / flights;
  state.counters["voxels"] = double(reads.voxels) / flights;
}

/// The flights themselves, 256 after each other and those so many times in a row: the second time
/// costs what a flight costs whose cells and voxels are at hand. The branches of 256 flights are
/// too many for the processor to remember.
void flights(benchmark::State& state) {
  constexpr std::size_t kGroup = 256;
  static_assert(kFlights % kGroup == 0);
  const auto cloudy = make_heterogeneous_medium(
      cloud(), kExtinction, std::make_shared<ConstantField>(Rgb(0.995f)), {0.8f});
  const Reads& reads = recorded().reads;
  const auto times = int(state.range(0));
  for (auto _ : state)
    for (std::size_t group = 0; group < kFlights; group += kGroup)
      for (int time = 0; time < times; ++time)
        for (std::size_t i = group; i < group + kGroup; ++i) {
          Sampler sampler(5, 0, std::uint32_t(i), false);
          benchmark::DoNotOptimize(
              cloudy->sample_free_flight(reads.rays[i], kInfinity, Rgb(1.0f), sampler));
        }
  count(state);
}
BENCHMARK(flights)->ArgName("times")->Arg(1)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);

/// Only what they read. With `wait`, no read begins before the one before it is done, as in
/// tracking, where each decides what comes next.
void reads_alone(benchmark::State& state) {
  const auto& [bounds, voxels, reads] = recorded();
  const bool wait = state.range(0) != 0;
  for (auto _ : state) {
    float sum = 0.0f;
    int hold = 0;  // always 0, which the processor learns only from the value read
    for (std::size_t i = 0; i < reads.places.size(); ++i) {
      const glm::ivec3 place = reads.places[i] + hold;
      const float value = reads.is_voxel[i] ? voxels(place) : bounds.range(place).max;
      if (wait) hold = int(value * 1e-9f);
      sum += value;
    }
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(reads_alone)->ArgName("wait")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// The same loop over their list without following it.
void no_reads(benchmark::State& state) {
  const Reads& reads = recorded().reads;
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 0; i < reads.places.size(); ++i)
      sum += reads.is_voxel[i] ? reads.places[i].x : reads.places[i].y;
    benchmark::DoNotOptimize(sum);
  }
  count(state);
}
BENCHMARK(no_reads)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace brume
