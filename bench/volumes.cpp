// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/warp.h"
#include "medium/heterogeneous_medium.h"
#include "unit_cube_grid.h"
#include "volume/bounds_grid.h"
#include "volume/voxel_blocks.h"

namespace brume {
namespace {

constexpr int kVoxels = 128;  // along each side

/// A ball of waves in the unit cube, 0 outside.
std::shared_ptr<const Grid<float>> cloud() {
  static const auto grid = unit_cube_grid(kVoxels, [](const glm::ivec3& v) {
    const Vec3 p = (Vec3(v) + 0.5f) * (2.0f / kVoxels) - 1.0f;
    const float value = 1.0f - length_squared(p) +
                        0.4f * std::sin(9.0f * p.x) * std::sin(11.0f * p.y) * std::sin(10.0f * p.z);
    return value > 0.3f ? value : 0.0f;
  });
  return grid;
}

/// From the middle of the cloud into a random direction.
Ray random_ray(Rng& rng) {
  return {.o = Vec3(0.3f) + 0.4f * Vec3(rng.next_float(), rng.next_float(), rng.next_float()),
          .d = sample_uniform_sphere(rng.next_vec2())};
}

/// Points to look up: anywhere, or half a voxel apart along rays through the cloud.
class Points {
 public:
  explicit Points(bool along_rays) : along_rays_(along_rays) {}

  Vec3 next() {
    if (!along_rays_)
      return float(kVoxels - 1) * Vec3(rng_.next_float(), rng_.next_float(), rng_.next_float());
    if (step_-- == 0) {
      ray_ = random_ray(rng_);
      step_ = 32;
    }
    return float(kVoxels) * ray_.o + 0.5f * float(step_) * ray_.d;
  }

 private:
  bool along_rays_;
  Rng rng_{1};
  Ray ray_{};
  int step_ = 0;
};

template <class Lookup>
void look_up(benchmark::State& state, Lookup&& lookup) {
  Points points(state.range(0) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(lookup(points.next()));
}

void one_tap_blocks(benchmark::State& state) {
  const VoxelBlocks<float> voxels(*cloud());
  Rng rng(2);
  look_up(state, [&](const Vec3& p) { return voxels.stochastic(p, rng); });
}
BENCHMARK(one_tap_blocks)->ArgName("along_rays")->Arg(0)->Arg(1);

void one_tap_tree(benchmark::State& state) {
  GridLookup<float> lookup(*cloud());
  Rng rng(2);
  look_up(state, [&](const Vec3& p) { return lookup.stochastic(p, rng); });
}
BENCHMARK(one_tap_tree)->ArgName("along_rays")->Arg(0)->Arg(1);

void trilinear_tree(benchmark::State& state) {
  GridLookup<float> lookup(*cloud());
  look_up(state, [&](const Vec3& p) { return lookup.trilinear(p); });
}
BENCHMARK(trilinear_tree)->ArgName("along_rays")->Arg(0)->Arg(1);

void no_lookup(benchmark::State& state) {
  look_up(state, [](const Vec3& p) { return p; });
}
BENCHMARK(no_lookup)->ArgName("along_rays")->Arg(0)->Arg(1);

void walk_of_bounds(benchmark::State& state) {
  const BoundsGrid bounds(*cloud());
  Rng rng(3);
  std::int64_t cells = 0;
  for (auto _ : state) {
    const auto segment =
        clip_to_grid(random_ray(rng), kInfinity, bounds, cloud()->index_from_world());
    float sum = 0.0f;
    walk_cells(bounds, *segment, [&](const glm::ivec3& cell, float t0, float t1) {
      sum += bounds.range(cell).max * (t1 - t0);
      ++cells;
      return true;
    });
    benchmark::DoNotOptimize(sum);
  }
  state.counters["cells"] = benchmark::Counter(double(cells), benchmark::Counter::kAvgIterations);
}
BENCHMARK(walk_of_bounds);

std::shared_ptr<const Medium> medium(const benchmark::State& state) {
  return make_heterogeneous_medium(cloud(), float(state.range(0)),
                                   std::make_shared<ConstantField>(Rgb(0.99f)), {0.8f});
}

void free_flight(benchmark::State& state) {
  const auto cloudy = medium(state);
  Rng rng(4);
  std::uint32_t sample = 0;
  for (auto _ : state) {
    Sampler sampler(5, 0, sample++, true);
    benchmark::DoNotOptimize(
        cloudy->sample_free_flight(random_ray(rng), kInfinity, Rgb(1.0f), sampler));
  }
}
BENCHMARK(free_flight)->ArgName("extinction")->Arg(1)->Arg(10)->Arg(100)->Arg(1000);

void transmittance(benchmark::State& state) {
  const auto cloudy = medium(state);
  Rng rng(6);
  for (auto _ : state)
    benchmark::DoNotOptimize(cloudy->transmittance(random_ray(rng), kInfinity, rng));
}
BENCHMARK(transmittance)->ArgName("extinction")->Arg(1)->Arg(10)->Arg(100)->Arg(1000);

void phase_function(benchmark::State& state) {
  const HenyeyGreenstein phase{0.8f};
  Rng rng(7);
  Vec3 d(0.0f, 0.0f, 1.0f);
  for (auto _ : state) {
    d = phase.sample(d, rng.next_vec2()).d;
    benchmark::DoNotOptimize(d);
  }
}
BENCHMARK(phase_function);

}  // namespace
}  // namespace brume
