// SPDX-License-Identifier: Apache-2.0
#include "integrator/reference_integrator.h"

#include <cmath>

#include "core/frame.h"

namespace brume {

namespace {
/// Throughput below which a path ends. In a medium without a way out it would never reach 0: the
/// smallest float times 0.95 is the smallest float again.
constexpr float kFaintest = 1e-30f;
}  // namespace

ReferenceIntegrator::ReferenceIntegrator(const Scene& scene, const Camera& camera,
                                         const PathSettings& settings)
    : scene_(scene), camera_(camera), settings_(settings), camera_medium_(scene, camera) {}

Rgb ReferenceIntegrator::dirac_light(const Vec3& p, Sampler& sampler, Vec3& d,
                                     float& distance) const {
  const auto arrival = scene_.lights().sample(p, sampler.next_1d(), sampler.next_2d());
  if (!arrival || std::isfinite(arrival->light.pdf)) return Rgb{0.0f};
  d = arrival->light.d;
  distance = arrival->light.distance;
  return arrival->light.weight;
}

Rgb ReferenceIntegrator::analog_transmittance(Ray ray, float distance, const Medium* medium,
                                              Sampler& sampler) const {
  Rgb T{1.0f};
  while (true) {
    const auto hit = scene_.intersect(ray, distance);
    if (!hit && !(distance < kInfinity)) medium = scene_.medium_to_infinity(medium);
    if (medium != nullptr) {
      const FreeFlight flight =
          medium->sample_free_flight(ray, hit ? hit->t : distance, T, sampler);
      if (flight.scattered) return Rgb{0.0f};
      T *= flight.weight;
    }
    if (!hit) return T;
    const Frame frame(hit->n_shading, hit->dp_du);
    T *= scene_.bsdf(*hit).straight_transmittance(frame.to_local(-ray.d), hit->uv);
    if (is_black(T)) return T;
    medium = scene_.medium_across(*hit, ray.d, medium);
    distance -= hit->t;
    ray = hit->leave_toward(ray.d, distance);
  }
}

Rgb ReferenceIntegrator::sample(const Vec2& film, Sampler& sampler) const {
  Ray ray = camera_.ray(film, sampler.next_2d()).ray;
  const Medium* medium = camera_medium_.at(ray);
  Rgb beta{1.0f};
  Rgb L{0.0f};
  int depth = 0;
  const auto may_scatter = [&] {
    return settings_.max_depth < 0 || depth + 1 < settings_.max_depth;
  };

  while (max_component(beta) > kFaintest) {
    const auto hit = scene_.intersect(ray, kInfinity);
    if (!hit) medium = scene_.medium_to_infinity(medium);
    if (medium != nullptr) {
      const FreeFlight flight =
          medium->sample_free_flight(ray, hit ? hit->t : kInfinity, beta, sampler);
      beta *= flight.weight;
      if (flight.scattered) {
        if (!may_scatter()) break;
        ++depth;
        const Vec3 p = ray.at(flight.t);
        Vec3 d;
        float distance;
        const Rgb light = dirac_light(p, sampler, d, distance);
        if (!is_black(light) && !flight.phase.is_delta())
          L += beta * light * flight.phase.eval(ray.d, d) *
               analog_transmittance({p, d}, distance, medium, sampler);
        ray = {p, flight.phase.sample(ray.d, sampler.next_2d()).d};
        continue;
      }
    }
    if (!hit) {
      L += beta * scene_.lights().environment_radiance(ray.d);
      break;
    }
    if (const auto emission = scene_.emission(ray.o, *hit, ray.d)) L += beta * emission->L;

    const Bsdf& bsdf = scene_.bsdf(*hit);
    const Frame frame(hit->n_shading, hit->dp_du);
    const Vec3 wo = frame.to_local(-ray.d);
    if (may_scatter()) {
      Vec3 d;
      float distance;
      const Rgb light = dirac_light(hit->p, sampler, d, distance);
      if (!is_black(light)) {
        const Rgb value = bsdf.eval(wo, frame.to_local(d), hit->uv);
        if (!is_black(value)) {
          const Ray shadow = hit->leave_toward(d, distance);
          L += beta * light * value *
               analog_transmittance(shadow, distance, scene_.medium_toward(*hit, -ray.d, d, medium),
                                    sampler);
        }
      }
    }

    const auto next = bsdf.sample(wo, hit->uv, sampler.next_1d(), sampler.next_2d());
    if (!next) break;
    beta *= next->weight;
    if (!next->straight) {
      if (!may_scatter()) break;
      ++depth;
    }
    const Vec3 d = next->straight ? ray.d : frame.to_world(next->wi);
    medium = scene_.medium_toward(*hit, -ray.d, d, medium);
    ray = hit->leave(d);
  }
  return L;
}

}  // namespace brume
