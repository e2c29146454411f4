// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "core/rng.h"
#include "core/warp.h"
#include "geometry/ray_queries.h"
#include "geometry/sphere.h"
#include "light/light_set.h"
#include "light/point_light.h"
#include "light/sky.h"

namespace brume {
namespace {

LightSet daylight() {
  const Daylight day = make_daylight(glm::normalize(Vec3(0.3f, 0.7f, 0.4f)), 3.0f);
  return LightSet({}, {day.sky, day.sun});
}

void sample_daylight(benchmark::State& state) {
  const LightSet lights = daylight();
  Rng rng(1);
  for (auto _ : state) {
    const float u = rng.next_float();
    benchmark::DoNotOptimize(lights.sample(Vec3(0.0f), u, rng.next_vec2()));
  }
}
BENCHMARK(sample_daylight);

void view_daylight(benchmark::State& state) {
  const LightSet lights = daylight();
  Rng rng(2);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        lights.environment_view(Vec3(0.0f), sample_uniform_sphere(rng.next_vec2())));
}
BENCHMARK(view_daylight);

void sample_lamps(benchmark::State& state) {
  Rng rng(3);
  std::vector<std::shared_ptr<const Light>> lamps;
  for (int i = 0; i < int(state.range(0)); ++i)
    lamps.push_back(
        std::make_shared<PointLight>(10.0f * sample_uniform_sphere(rng.next_vec2()), Rgb(1.0f)));
  const LightSet lights(lamps, {});
  for (auto _ : state) {
    const float u = rng.next_float();
    benchmark::DoNotOptimize(lights.sample(Vec3(0.0f), u, rng.next_vec2()));
  }
}
BENCHMARK(sample_lamps)->ArgName("lamps")->Arg(1)->Arg(10)->Arg(100)->Arg(1000);

/// Among spheres in a ball around the origin.
template <class Query>
void ray_query(benchmark::State& state, Query&& query) {
  Rng rng(4);
  std::vector<std::shared_ptr<const Shape>> spheres;
  for (int i = 0; i < int(state.range(0)); ++i)
    spheres.push_back(
        std::make_shared<Sphere>(10.0f * sample_uniform_sphere(rng.next_vec2()), 0.5f, false));
  const RayQueries queries(spheres);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        query(queries, Ray{Vec3(0.0f), sample_uniform_sphere(rng.next_vec2())}));
}

void nearest_hit(benchmark::State& state) {
  ray_query(state, [](const RayQueries& q, const Ray& ray) { return q.intersect(ray, kInfinity); });
}
BENCHMARK(nearest_hit)->ArgName("spheres")->Arg(10)->Arg(1000);

void any_hit(benchmark::State& state) {
  ray_query(state, [](const RayQueries& q, const Ray& ray) {
    return q.obstacle(ray, kInfinity) != Obstacle::kNone;
  });
}
BENCHMARK(any_hit)->ArgName("spheres")->Arg(10)->Arg(1000);

}  // namespace
}  // namespace brume
