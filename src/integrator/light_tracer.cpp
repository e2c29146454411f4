// SPDX-License-Identifier: Apache-2.0
#include "integrator/light_tracer.h"

#include <cmath>

#include "core/frame.h"

namespace brume {
namespace {
/// Scatterings after which every path ends sooner or later: of those that lose nothing a share of
/// n^-1.5 gets as far as n, so that their mean length is finite and their weights grow slowly.
constexpr int kLongPath = 64;
}  // namespace

struct LightTracer::Path {
  Ray ray;
  const Medium* medium;  // around the ray's origin; null is vacuum
  Rgb power;             // that the path carries [W]
  float full_power;      // that it began with, its largest channel [W]
  bool sees_point;       // whether a mirror would still show a lamp without extent
  int scatterings = 0;
};

Rgb scattered_toward(const Scene& scene, const LightVertex& vertex, const Vec3& d) {
  if (!vertex.hit) return Rgb{vertex.phase.eval(vertex.d, d)};
  const Hit& hit = *vertex.hit;
  const Frame frame(hit.n_shading, hit.dp_du);
  const Vec3 wo = frame.to_local(d), wi = frame.to_local(-vertex.d);
  const float cos_o = glm::dot(d, hit.n), cos_i = glm::dot(-vertex.d, hit.n);
  // `eval` has the cosine with which the camera's path sees the lamp; a path of light brings the
  // geometric one itself and is seen under the other (Veach 1997, section 5.3).
  return scene.bsdf(hit).eval(wo, wi, hit.uv) * std::abs(cos_o / cos_i);
}

LightTracer::LightTracer(const Scene& scene, int max_scatterings)
    : scene_(scene), max_scatterings_(max_scatterings) {
  const LightSet& lights = scene_.lights();
  if (lights.has_environment()) return;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights.light(i);
    const auto somewhere = light.emit(Vec2(0.5f), Vec2(0.5f));
    const auto pivot = light.pivot();
    if (!somewhere || !pivot) {
      lamps_.clear();
      return;
    }
    lamps_.push_back({.light = &light,
                      .p = somewhere->ray.o,
                      .medium = scene_.medium_at(somewhere->ray.o).medium,
                      .power = pivot->intensity,
                      .is_point = pivot->radius == 0.0f});
  }
}

void LightTracer::trace(const Lamp& lamp, const Vec2& u_direction, float weight, Sampler& sampler,
                        std::vector<LightVertex>& vertices) const {
  const auto emitted = lamp.light->emit(sampler.next_2d(), u_direction);
  const Rgb power = weight * emitted->power;
  Path path{.ray = emitted->ray,
            .medium = scene_.medium_beside(lamp.p, lamp.medium, emitted->ray.o),
            .power = power,
            .full_power = max_component(power),
            .sees_point = lamp.is_point};

  bool alive = !is_black(power);
  for (std::uint32_t flight_number = 0; alive; ++flight_number) {
    sampler.begin_flight(flight_number);
    const auto hit = scene_.intersect(path.ray, kInfinity);
    if (!hit) path.medium = scene_.medium_to_infinity(path.medium);
    if (path.medium != nullptr) {
      const FreeFlight flight =
          path.medium->sample_free_flight(path.ray, hit ? hit->t : kInfinity, path.power, sampler);
      path.power *= flight.weight;
      if (is_black(path.power)) return;
      if (flight.scattered) {
        alive = scatter_in_medium(path, flight, sampler, vertices);
        continue;
      }
    }
    alive = hit && interact_with_surface(path, *hit, sampler, vertices);
  }
}

bool LightTracer::scatter_in_medium(Path& path, const FreeFlight& flight, Sampler& sampler,
                                    std::vector<LightVertex>& vertices) const {
  ++path.scatterings;
  const Vec3 p = path.ray.at(flight.t);
  if (!flight.phase.is_delta()) {
    vertices.push_back({.p = p,
                        .d = path.ray.d,
                        .power = path.power,
                        .scatterings = path.scatterings,
                        .medium = path.medium,
                        .phase = flight.phase});
    path.sees_point = false;
  }
  path.ray = {p, flight.phase.sample(path.ray.d, sampler.next_2d()).d};
  return !path.sees_point && survives_roulette(path, sampler);
}

bool LightTracer::interact_with_surface(Path& path, const Hit& hit, Sampler& sampler,
                                        std::vector<LightVertex>& vertices) const {
  const Bsdf& bsdf = scene_.bsdf(hit);
  const Frame frame(hit.n_shading, hit.dp_du);
  const Vec3 wi = frame.to_local(-path.ray.d);
  const float u_lobe = sampler.next_1d();
  const auto next = bsdf.sample(wi, hit.uv, u_lobe, sampler.next_2d());
  const bool goes_on = next && !is_black(next->weight);
  if (goes_on && next->straight) {
    path.power *= next->weight;
    path.medium = scene_.medium_across(hit, path.ray.d, path.medium);
    path.ray = hit.leave(path.ray.d);
    return true;
  }

  ++path.scatterings;
  const float cos_here = glm::dot(-path.ray.d, hit.n);
  if (!(wi.z * cos_here > 0.0f)) return false;  // light must not leak through shading normals
  if (bsdf.has_smooth_lobe() && (goes_on || !bsdf.is_diffuse()))
    vertices.push_back({.p = hit.p,
                        .d = path.ray.d,
                        .power = path.power,
                        .scatterings = path.scatterings,
                        .medium = path.medium,
                        .hit = hit});
  if (!goes_on) return false;
  const Vec3 d = frame.to_world(next->wi);

  // What a path from the camera would be worth, seen from the other end: refraction does not
  // concentrate power as it does radiance, and cosines to the shading normal change places.
  path.power *= next->weight * (next->eta * next->eta);
  path.power *= std::abs((wi.z * glm::dot(d, hit.n)) / (next->wi.z * cos_here));
  if (next->pdf < kInfinity) path.sees_point = false;
  path.medium = scene_.medium_toward(hit, -path.ray.d, d, path.medium);
  path.ray = hit.leave(d);
  return !path.sees_point && survives_roulette(path, sampler);
}

bool LightTracer::survives_roulette(Path& path, Sampler& sampler) const {
  if (path.scatterings >= max_scatterings_) return false;
  float p_survive = std::min(max_component(path.power) / path.full_power, 1.0f);
  if (path.scatterings >= kLongPath)
    p_survive = std::min(p_survive, 1.0f - 1.5f / float(path.scatterings));
  if (!(sampler.next_1d() < p_survive)) return false;
  path.power /= p_survive;
  return true;
}

}  // namespace brume
