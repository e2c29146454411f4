// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_path_guide.h"

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "light/toward.h"

namespace brume {
namespace {

/// Of no picture.
constexpr std::uint64_t kTrialSeed = 0x6c69676874206973;
/// Paths that learn in which directions light leaves the lamps, and then, so guided, where it is
/// seen from; a trial ends earlier once it has found many places.
constexpr int kDirectionTrials = 16384, kPlaceTrials = 4096;
constexpr std::size_t kMostTrialVertices = 16384;
/// Each place is judged by so many receivers.
constexpr int kReceiversPerPlace = 4;

constexpr int kDirectionBins = 32;            // along each axis of u_direction
constexpr std::size_t kMostGuidedLamps = 16;  // others emit as they would unguided
constexpr float kUniformShare = 0.25f;        // of the mean, that every bin gets besides its own

constexpr int kCellsAcross = 8;  // of the box around all places, along each axis
constexpr int kKinds = 7;        // in a medium, or on a surface that faces one of six ways
/// However useless a place seemed to be.
constexpr float kLeastKept = 0.25f;

std::vector<float> powers(const LightTracer& tracer) {
  std::vector<float> result;
  for (const LightTracer::Lamp& lamp : tracer.lamps()) result.push_back(lamp.power);
  return result;
}

/// The weights of bins and, less, of those around them.
std::vector<float> blurred(std::span<const float> bins) {
  constexpr std::array<float, 3> kWeight = {0.25f, 0.5f, 0.25f};
  const auto clamped = [](int i) { return std::clamp(i, 0, kDirectionBins - 1); };
  std::vector<float> result(bins.size(), 0.0f);
  for (int y = 0; y < kDirectionBins; ++y)
    for (int x = 0; x < kDirectionBins; ++x)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          result[std::size_t(y * kDirectionBins + x)] +=
              kWeight[std::size_t(i)] * kWeight[std::size_t(j)] *
              bins[std::size_t(clamped(y + j - 1) * kDirectionBins + clamped(x + i - 1))];
  return result;
}

std::size_t direction_bin(const Vec2& u) {
  const auto along = [](float x) { return std::min(int(x * kDirectionBins), kDirectionBins - 1); };
  return std::size_t(along(u.y) * kDirectionBins + along(u.x));
}

/// Light that would reach `receiver` from `vertex`, roughly, in luminance; `near_squared` softens
/// the inverse square of the distance.
float light_at(const Receiver& receiver, const LightVertex& vertex, const Scene& scene,
               float near_squared, Rng& rng) {
  const Vec3 way = receiver.p - vertex.p;
  const float squared = length_squared(way);
  if (!(squared > 0.0f)) return 0.0f;
  const Vec3 d = way / std::sqrt(squared);
  // Surfaces are taken for diffuse ones: four times the cosine, relative to isotropic scattering.
  float value = receiver.weight * luminance(vertex.power) / (squared + near_squared);
  Ray ray{.o = vertex.p, .d = d};
  if (vertex.hit) {
    const float cosine = glm::dot(d, vertex.hit->n);
    if (!(cosine * glm::dot(vertex.d, vertex.hit->n) < 0.0f)) return 0.0f;
    value *= 4.0f * std::abs(cosine);
    ray = vertex.hit->leave(d);
  } else {
    value *= 4.0f * kPi * vertex.phase.eval(vertex.d, d);
  }
  glm::dvec3 target(receiver.p);
  if (receiver.hit) {
    const float cosine = glm::dot(d, receiver.hit->n);
    if (!(cosine * glm::dot(receiver.d, receiver.hit->n) > 0.0f)) return 0.0f;
    value *= 4.0f * std::abs(cosine);
    target = receiver.hit->point().end_of_ray_from(ray.o);
  }
  const Toward toward(ray.o, target);
  if (!(toward.distance > 0.0)) return 0.0f;
  return value * luminance(scene.transmittance({ray.o, toward.d}, float(toward.distance),
                                               vertex.medium, rng));
}

}  // namespace

std::vector<Receiver> find_receivers(const Scene& scene, const Camera& camera,
                                     const CameraMedium& camera_medium, int count) {
  std::vector<Receiver> receivers;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(kTrialSeed, std::uint32_t(i), 0, true);
    const Vec2 film = sampler.next_2d();
    CameraRay camera_ray = camera.ray(film, sampler.next_2d());
    auto& [ray, t_max] = camera_ray;
    const Medium* medium = camera_medium.at(ray);
    Rgb beta{1.0f};
    for (bool alive = true; alive;) {
      const auto hit = scene.intersect(ray, t_max);
      if (!hit && !(t_max < kInfinity)) medium = scene.medium_to_infinity(medium);
      if (medium != nullptr) {
        const FreeFlight flight =
            medium->sample_free_flight(ray, hit ? hit->t : t_max, beta, sampler);
        beta *= flight.weight;
        if (flight.scattered) {
          receivers.push_back({ray.at(flight.t), ray.d, medium, {}, luminance(beta)});
          break;
        }
      }
      if (!hit) break;
      const Bsdf& bsdf = scene.bsdf(*hit);
      if (bsdf.has_smooth_lobe())
        receivers.push_back({hit->p, ray.d, medium, *hit, luminance(beta * bsdf.albedo(hit->uv))});
      alive = !bsdf.has_smooth_lobe() && bsdf.passes_straight();
      medium = scene.medium_across(*hit, ray.d, medium);
      t_max -= hit->t;
      ray = hit->leave(ray.d);
    }
  }
  return receivers;
}

/// Light paths and what they are worth.
struct LightPathGuide::Trial {
  struct Path {
    Start start;
    std::size_t end;  // of its vertices
  };
  std::vector<Path> paths;
  std::vector<LightVertex> vertices;
  std::vector<float> scores;  // [vertex]
};

LightPathGuide::LightPathGuide(const Scene& scene, const LightTracer& tracer,
                               std::span<const Receiver> receivers)
    : scene_(scene), tracer_(tracer), lamps_(powers(tracer)) {
  if (receivers.empty()) return;
  learn_directions(run_trial(kDirectionTrials, kTrialSeed, receivers));
  learn_places(run_trial(kPlaceTrials, kTrialSeed + 1, receivers));
}

LightPathGuide::Start LightPathGuide::start(Sampler& sampler) const {
  const Distribution1d::Sample lamp = lamps_.sample(sampler.next_1d());
  Start start{.lamp = lamp.index,
              .u_direction = sampler.next_2d(),
              .weight = 1.0f / lamps_.probability(lamp.index)};
  if (start.lamp < directions_.size()) {
    const Distribution2d::Sample direction = directions_[start.lamp].sample(start.u_direction);
    start.u_direction = direction.xy;
    start.weight /= direction.pdf;
  }
  return start;
}

LightPathGuide::Trial LightPathGuide::run_trial(int paths, std::uint64_t seed,
                                                std::span<const Receiver> receivers) const {
  Trial trial;
  Box3 bounds;
  for (int i = 0; i < paths && trial.vertices.size() < kMostTrialVertices; ++i) {
    Sampler sampler(seed, 0, std::uint32_t(i));
    const Start start_here = start(sampler);
    tracer_.trace(tracer_.lamps()[start_here.lamp], start_here.u_direction, start_here.weight,
                  sampler, trial.vertices);
    trial.paths.push_back({start_here, trial.vertices.size()});
  }
  for (const LightVertex& vertex : trial.vertices) bounds.extend(vertex.p);

  Rng rng(seed);
  const float near_squared = 2e-3f * length_squared(bounds.size());
  for (const LightVertex& vertex : trial.vertices) {
    float sum = 0.0f;
    for (int k = 0; k < kReceiversPerPlace; ++k) {
      const auto which = std::size_t(rng.next_float() * float(receivers.size()));
      sum += light_at(receivers[std::min(which, receivers.size() - 1)], vertex, scene_,
                      near_squared, rng);
    }
    trial.scores.push_back(std::isfinite(sum) ? sum / float(kReceiversPerPlace) : 0.0f);
  }
  return trial;
}

void LightPathGuide::learn_directions(const Trial& trial) {
  if (tracer_.lamps().size() > kMostGuidedLamps) return;
  constexpr std::size_t kBins = kDirectionBins * kDirectionBins;
  std::vector<std::vector<float>> scores(tracer_.lamps().size(), std::vector<float>(kBins, 0.0f));
  std::size_t vertex = 0;
  for (const Trial::Path& path : trial.paths)
    for (; vertex < path.end; ++vertex)
      scores[path.start.lamp][direction_bin(path.start.u_direction)] += trial.scores[vertex];

  for (const std::vector<float>& of_lamp : scores) {
    std::vector<float> weights = blurred(of_lamp);
    float mean = 0.0f;
    for (float& weight : weights) {
      weight = std::sqrt(weight);
      mean += weight / float(kBins);
    }
    for (float& weight : weights) weight += kUniformShare * mean;
    directions_.emplace_back(weights, kDirectionBins, kDirectionBins);
  }
}

void LightPathGuide::learn_places(const Trial& trial) {
  for (const LightVertex& vertex : trial.vertices) bounds_.extend(vertex.p);
  double total = 0.0;
  for (const float score : trial.scores) total += score;
  if (!(total > 0.0)) return;

  // The mean score of a cell, with one place of the overall mean among them.
  const auto mean = float(total / double(trial.scores.size()));
  constexpr std::size_t kCells = kKinds * kCellsAcross * kCellsAcross * kCellsAcross;
  std::vector<float> sums(kCells, mean), counts(kCells, 1.0f);
  for (std::size_t i = 0; i < trial.vertices.size(); ++i) {
    const std::size_t at = cell(trial.vertices[i]);
    sums[at] += trial.scores[i];
    counts[at] += 1.0f;
  }
  // Kept are all places that are at least half as good as where most of the light comes from.
  double typical = 0.0;
  for (std::size_t i = 0; i < kCells; ++i)
    typical += (sums[i] - mean) * (sums[i] / counts[i]) / total;
  keep_.reserve(kCells);
  for (std::size_t i = 0; i < kCells; ++i)
    keep_.push_back(std::clamp(sums[i] / counts[i] / float(0.5 * typical), kLeastKept, 1.0f));

  for (const LightVertex& vertex : trial.vertices)
    kept_per_path_ += keep(vertex) / float(trial.paths.size());

  int in_medium = 0;
  double length = 0.0;
  for (std::size_t i = 1; i < trial.vertices.size(); ++i) {
    const LightVertex &from = trial.vertices[i - 1], &to = trial.vertices[i];
    if (to.scatterings == 1) continue;  // another path
    distances_.push_back(glm::distance(from.p, to.p));
    length += distances_.back();
    in_medium += to.hit ? 0 : 1;
  }
  if (length > 0.0) sigma_t_ = float(in_medium / length);
}

std::size_t LightPathGuide::cell(const LightVertex& vertex) const {
  const Vec3 size = glm::max(bounds_.size(), Vec3(std::numeric_limits<float>::min()));
  const Vec3 x = (vertex.p - bounds_.min) / size * float(kCellsAcross);
  const auto along = [](float f) {
    return std::size_t(std::clamp(f, 0.0f, float(kCellsAcross - 1)));
  };
  std::size_t kind = 0;
  if (vertex.hit) {
    const Vec3 n = glm::dot(vertex.d, vertex.hit->n) < 0.0f ? vertex.hit->n : -vertex.hit->n;
    const Vec3 a = glm::abs(n);
    const int axis = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    kind = std::size_t(1 + 2 * axis + (n[axis] > 0.0f ? 1 : 0));
  }
  return ((kind * kCellsAcross + along(x.z)) * kCellsAcross + along(x.y)) * kCellsAcross +
         along(x.x);
}

float LightPathGuide::keep(const LightVertex& vertex) const {
  return keep_[cell(vertex)];
}

}  // namespace brume
