// SPDX-License-Identifier: Apache-2.0
#include "integrator/path_integrator.h"

#include <cmath>

#include "core/frame.h"
#include "core/warp.h"
#include "integrator/segment_lighting.h"
#include "light/toward.h"

namespace brume {

namespace {
/// Flights after which roulette stops every path sooner or later, and after which a path is taken
/// for one that has no way out.
constexpr int kLongPath = 3000, kLostPath = 100'000;
/// Scatterings up to which every flight looks for lights near to it. Later ones matter less, but
/// light that they find much closer to a lamp than they are long has no bound: those that come
/// within this part of their length look for it too.
constexpr int kDepthThatSeeksLights = 2;
constexpr float kNearLight = 0.1f;
/// Where light paths are met: paths over the share of the pixel's light that they stand for, and
/// how many of those that the camera's flight splits into scatter at most.
constexpr float kPathsPerShare = 8.0f;
constexpr int kMostScattered = 2;
/// Paths that have scattered from which the brightness of what scatters is learnt, and the camera
/// samples after which the search for them ends.
constexpr int kScatteredSamples = 64, kMostPilotSamples = 4096;
/// A seed of no picture.
constexpr std::uint64_t kPilotSeed = 0x62727570696c6f74;

using Lanes = LightPathSet::Lanes;

/// Whether a direction is on the same side of a surface for its shading normal, where it is
/// `local`, as for its geometric one, where it is `world`: light must not leak.
bool is_same_side(const Vec3& local, const Vec3& world, const Hit& hit) {
  return local.z * glm::dot(world, hit.n) > 0.0f;
}
}  // namespace

struct PathIntegrator::Path {
  Ray ray;
  float t_max;           // the camera's far clip before the first event, then infinite [unit]
  const Medium* medium;  // around the ray's origin; null is vacuum
  Rgb beta{1.0f};        // throughput
  Rgb L{0.0f};           // radiance gathered [W/(m^2 sr)]
  Rgb escaped{0.0f};     // throughput with which it left the scene before it scattered
  Vec3 vertex{ray.o};    // where the direction was chosen
  float pdf_dir =
      kInfinity;          // density of that choice [1/sr]; infinite: light sampling cannot make it
  float pdf_met = 0.0f;   // `pdf_dir` if light paths were met at `vertex`, else 0
  Segment segment{};      // that ended at `vertex`, if it lies in a medium; else no medium
  float t_vertex = 0.0f;  // where it did [unit]
  float eta_squared = 1.0f;  // of refractions so far, which beta carries and roulette must not see
  int depth = 0;             // scattering events
  int segments = 0;          // flights, through index-matched boundaries too
  int flights = 0;           // those of the paths that it split into, too
  CameraSample first{};      // albedo and depth of the first event
  float t_first = 0.0f;      // length of the flights before it [unit]
  const LightPathSet* light{};  // paths to be met; null: none
  std::uint32_t bundle = 0;     // of `light`
};

PathIntegrator::PathIntegrator(const Scene& scene, const Camera& camera,
                               const PathSettings& settings)
    : scene_(scene), camera_(camera), settings_(settings), camera_medium_(scene, camera) {
  const bool has_similar_media = settings_.approximations.similarity != Approximations{}.similarity;
  if (settings_.lighting.light_paths && scatterings_after(1) > 0 && !has_similar_media) {
    light_paths_ =
        std::make_unique<const LightPaths>(scene, camera, camera_medium_, scatterings_after(1));
    if (!light_paths_->exist()) light_paths_.reset();
  }
  if (!settings_.hide_emitters && scene_.lights().has_environment())
    scattered_luminance_ = learn_scattered_luminance();
}

float PathIntegrator::learn_scattered_luminance() const {
  float sum = 0.0f;
  int scattered = 0;
  for (int i = 0; i < kMostPilotSamples && scattered < kScatteredSamples; ++i) {
    Sampler sampler(kPilotSeed, std::uint32_t(i), 0, true);
    const Vec2 film = sampler.next_2d();
    const CameraRay camera_ray = camera_.ray(film, sampler.next_2d());
    const Path path = trace(camera_ray, camera_medium_.at(camera_ray.ray), sampler, {});
    sum += luminance(path.L);
    scattered += path.depth > 0 ? 1 : 0;
  }
  return scattered > 0 ? sum / float(scattered) : 0.0f;
}

float PathIntegrator::share_of_escape(const Rgb& background) const {
  const float L = luminance(background);
  if (!(L > 0.0f)) return 0.0f;
  return scattered_luminance_ < L ? scattered_luminance_ / L : 1.0f;
}

PathIntegrator::Path PathIntegrator::trace(const CameraRay& camera_ray, const Medium* medium,
                                           Sampler& sampler, const LightPaths::Key& shared) const {
  Path path{.ray = camera_ray.ray, .t_max = camera_ray.t_max, .medium = medium};
  std::shared_ptr<const LightPathSet> light;
  if (light_paths_ != nullptr) {
    light = light_paths_->of(shared);
    path.light = light.get();
    path.bundle = sampler.index_in_block();
  }
  follow(path, sampler);
  return path;
}

void PathIntegrator::follow(Path& path, Sampler& sampler) const {
  for (bool alive = true; alive; ++path.segments) {
    ++path.flights;
    sampler.begin_flight(std::uint32_t(path.segments));
    const auto hit = scene_.intersect(path.ray, path.t_max);
    if (hit) add_emission(path, *hit, sampler);
    if (!hit && !(path.t_max < kInfinity)) path.medium = scene_.medium_to_infinity(path.medium);
    if (path.medium != nullptr) {
      const Medium& around = medium_around(path);
      const float t_end = hit ? hit->t : path.t_max;
      const Segment segment{.ray = path.ray,
                            .t_end = t_end,
                            .beta = path.beta,
                            .medium = &around,
                            .seeks_lights = seeks_lights(path, around, t_end)};
      if (path.light == nullptr || path.depth > 0 || !split(path, segment, sampler)) {
        const FreeFlight flight =
            around.sample_free_flight(path.ray, segment.t_end, path.beta, sampler);
        path.beta *= flight.weight;
        const PhaseSample next = next_direction(path, flight, sampler);
        if (may_scatter(path)) light_segment(path, segment, flight, sampler);
        if (flight.scattered && !is_black(path.beta)) {
          alive = scatter_in_medium(path, segment, flight, next, sampler) &&
                  survives_roulette(path, sampler);
          continue;
        }
      }
      if (is_black(path.beta)) break;
    }
    if (!hit) {
      if (path.depth > 0)
        add_environment(path);
      else
        path.escaped = path.beta;
      break;
    }
    alive = interact_with_surface(path, *hit, sampler) && survives_roulette(path, sampler);
  }
}

bool PathIntegrator::seeks_lights(const Path& path, const Medium& around, float t_end) const {
  if (!settings_.lighting.near_lights) return false;
  if (path.depth < kDepthThatSeeksLights) return true;
  const auto scattering = around.scattering_at(path.ray, 0.0f, path.beta);
  if (!scattering || is_black(scattering->value)) return false;
  const float length = std::min(1.0f / max_component(scattering->value), t_end);
  return scene_.lights().lights_with_pivot().is_within(kNearLight * length, path.ray, t_end);
}

bool PathIntegrator::split(Path& path, Segment segment, Sampler& sampler) const {
  if (!may_scatter(path)) return false;
  const auto p_scatter =
      segment.medium->probability_of_scattering(segment.ray, segment.t_end, segment.beta);
  if (!p_scatter) return false;

  const float wanted =
      std::min(kPathsPerShare * *p_scatter * max_component(path.beta), float(kMostScattered));
  if (wanted > 0.0f) {
    const int count = std::min(int(wanted + sampler.rng().next_float()), kMostScattered);
    segment.p_scatter = *p_scatter;
    segment.beta /= wanted;
    const bool is_scattering_first = sampler.rng().next_float() < *p_scatter;
    for (int i = 0; i < std::max(count, 1); ++i) {
      Sampler own = sampler.split(std::uint32_t(i));
      const FreeFlight flight =
          segment.medium->sample_scattering(segment.ray, segment.t_end, path.beta, own);
      if (i == 0 && is_scattering_first) see_first(path, flight);
      if (i < count) follow_scattered(path, segment, flight, own);
    }
  }

  path.beta *= segment.medium->transmittance(segment.ray, segment.t_end, sampler.rng());
  if (!std::isfinite(segment.t_end)) return true;  // nothing stands there that would cost time
  const float p_pass = std::min(kPathsPerShare * max_component(path.beta), 1.0f);
  if (sampler.rng().next_float() < p_pass)
    path.beta /= p_pass;
  else
    path.beta = Rgb{0.0f};
  return true;
}

void PathIntegrator::follow_scattered(Path& path, const Segment& segment, const FreeFlight& flight,
                                      Sampler& sampler) const {
  Path scattered = path;
  scattered.L = Rgb{0.0f};
  scattered.flights = 1;
  scattered.beta = segment.beta * flight.weight * segment.p_scatter;
  const PhaseSample next = next_direction(scattered, flight, sampler);
  light_segment(scattered, segment, flight, sampler);
  if (scatter_in_medium(scattered, segment, flight, next, sampler) &&
      survives_roulette(scattered, sampler)) {
    ++scattered.segments;
    follow(scattered, sampler);
  }
  path.L += scattered.L;
  path.flights += scattered.flights;
}

void PathIntegrator::see_first(Path& path, const FreeFlight& flight) const {
  if (std::isfinite(path.first.depth)) return;
  path.first.depth = path.t_first + flight.t;
  path.first.albedo = glm::min(flight.weight, Rgb{1.0f});
}

CameraSample PathIntegrator::sample(const Vec2& film, Sampler& sampler,
                                    const LightPaths::Key& shared) const {
  const CameraRay camera_ray = camera_.ray(film, sampler.next_2d());
  const Medium* medium = camera_medium_.at(camera_ray.ray);
  const Path path = trace(camera_ray, medium, sampler, shared);

  Rgb background{0.0f};
  if (!settings_.hide_emitters) background = scene_.lights().environment_radiance(camera_ray.ray.d);
  const float share = share_of_escape(background);
  Rgb T = path.escaped;
  if (share < 1.0f) {
    const Rgb estimate =
        scene_.transmittance(camera_ray.ray, camera_ray.t_max, medium, sampler.rng());
    T = glm::mix(estimate, T, share);
  }
  CameraSample result = path.first;
  result.alpha = 1.0f - std::min(mean(T), 1.0f);  // by rounding T may be more
  result.L = path.L + background * T;
  result.work = float(path.flights);
  return result;
}

bool PathIntegrator::may_scatter(const Path& path) const {
  return settings_.max_depth < 0 || path.depth + 1 < settings_.max_depth;
}

int PathIntegrator::scatterings_after(int scatterings) const {
  constexpr int kUnlimited = std::numeric_limits<int>::max();
  return settings_.max_depth < 0 ? kUnlimited : settings_.max_depth - 1 - scatterings;
}

bool PathIntegrator::is_diffuse(int scatterings) const {
  return scatterings >= settings_.approximations.similarity;
}

const Medium& PathIntegrator::medium_around(const Path& path) const {
  return is_diffuse(path.depth) ? path.medium->similar() : *path.medium;
}

void PathIntegrator::gather(Path& path, const Rgb& L, int scatterings) const {
  const float limit = settings_.approximations.clamp;
  const float largest = max_component(L);
  path.L += scatterings > 1 && largest > limit ? L * (limit / largest) : L;
}

void PathIntegrator::light_segment(Path& path, const Segment& segment, const FreeFlight& flight,
                                   Sampler& sampler) const {
  const SegmentLighting lighting(scene_.lights(), segment);
  const float u_light = sampler.next_1d();
  const Vec2 u_target = sampler.next_2d();
  const Vec3 d = segment.ray.d;

  const Vec2 u_near = lighting.p_near() > 0.0f ? sampler.next_2d() : Vec2(1.0f);
  if (u_near.x < lighting.p_near()) {
    const SegmentLighting::Point point = lighting.sample(u_light, u_near.y);
    const Vec3 p = segment.ray.at(point.t);
    const float left = left_by_light_paths(path, p, sampler);
    if (left == 0.0f) return;
    const auto light = scene_.lights().light(point.light).sample(p, u_target);
    if (!light) return;
    const auto scattering = segment.medium->scattering_at(segment.ray, point.t, segment.beta);
    const float value = scattering->phase.eval(d, light->d);
    const float density = (1.0f - lighting.p_near()) * scattering->pdf / segment.p_scatter *
                              scene_.lights().probability(p, point.light) +
                          lighting.p_near() * point.pdf;
    const float weight =
        power_heuristic(density * light->pdf, scattering->pdf / segment.p_scatter * value);
    connect(path, p, *light, left * segment.beta * scattering->value / density, value * weight,
            sampler);
    return;
  }

  if (!flight.scattered || flight.phase.is_delta()) return;
  const Vec3 p = segment.ray.at(flight.t);
  const float left = left_by_light_paths(path, p, sampler);
  if (left == 0.0f) return;
  const auto arrival = scene_.lights().sample(p, u_light, u_target);
  if (!arrival) return;
  const float value = flight.phase.eval(d, arrival->light.d);
  const float mixture =
      lighting.choice(arrival->index, flight.t, arrival->p_choice) / arrival->p_choice;
  const float weight = power_heuristic(arrival->light.pdf * mixture, value);
  connect(path, p, arrival->light, left * path.beta / mixture, value * weight, sampler);
}

void PathIntegrator::connect(Path& path, const Vec3& p, const LightSample& light, const Rgb& beta,
                             float value, Sampler& sampler) const {
  // A shadow ray costs as much as a scattering: directions into which less is scattered than
  // isotropically get one only with that proportion.
  const float p_trace =
      settings_.lighting.shadow_roulette ? std::min(4.0f * kPi * value, 1.0f) : 1.0f;
  if (!(sampler.rng().next_float() < p_trace)) return;
  const Rgb T = scene_.transmittance({p, light.d}, light.distance, path.medium, sampler.rng(),
                                     is_diffuse(path.depth + 1));
  gather(path, beta * T * light.weight * (value / p_trace), path.depth + 1);
}

void PathIntegrator::light_surface(Path& path, const Hit& hit, const Rgb& beta,
                                   Sampler& sampler) const {
  const Bsdf& bsdf = scene_.bsdf(hit);
  const float u_light = sampler.next_1d();
  const auto arrival = scene_.lights().sample(hit.p, u_light, sampler.next_2d());
  if (!arrival || !bsdf.has_smooth_lobe() || !may_scatter(path)) return;
  const LightSample& light = arrival->light;
  const Frame frame(hit.n_shading, hit.dp_du);
  const Vec3 wo = frame.to_local(-path.ray.d), wi = frame.to_local(light.d);
  const Rgb value = bsdf.eval(wo, wi, hit.uv);
  if (is_black(value) || !is_same_side(wi, light.d, hit)) return;
  const float weight = power_heuristic(light.pdf, bsdf.pdf(wo, wi, hit.uv));
  float distance = light.distance;
  const Ray shadow = hit.leave_toward(light.d, distance);
  const Medium* medium = scene_.medium_toward(hit, -path.ray.d, light.d, path.medium);
  const Rgb T =
      scene_.transmittance(shadow, distance, medium, sampler.rng(), is_diffuse(path.depth + 1));
  gather(path, beta * value * T * light.weight * weight, path.depth + 1);
}

float PathIntegrator::left_by_light_paths(const Path& path, const Vec3& p, Sampler& sampler) const {
  if (!(path.pdf_met > 0.0f)) return 1.0f;
  const float share = light_paths_->camera_share(glm::distance(p, path.vertex), path.pdf_met);
  const float p_survive =
      std::min(kPathsPerShare * share * max_component(path.beta) * path.eta_squared, 1.0f);
  return sampler.rng().next_float() < p_survive ? share / p_survive : 0.0f;
}

void PathIntegrator::meet_light_paths(Path& path, const Vec3& p, const HenyeyGreenstein& phase,
                                      Sampler& sampler) const {
  const Vec3 d_in = path.ray.d;
  const auto seen = [&](const Lanes& x, const Lanes& y, const Lanes& z) {
    const Lanes value =
        LightPathSet::henyey_greenstein(phase.g, d_in.x * x + d_in.y * y + d_in.z * z);
    return LightPathSet::Seen{value, value};
  };
  const auto choice = path.light->choose(path.bundle, p, scatterings_after(path.depth), seen,
                                         sampler.rng().next_float());
  if (!choice) return;
  const float distance = glm::distance(choice->vertex->p, p);
  const Vec3 d = (choice->vertex->p - p) / distance;
  const float value = phase.eval(d_in, d);
  const float share = light_paths_->light_share(distance, value);
  meet(path, {p, d}, *choice, path.medium, path.beta * value, share, path.depth, sampler);
}

void PathIntegrator::meet_light_paths(Path& path, const Hit& hit, Sampler& sampler) const {
  const Bsdf& bsdf = scene_.bsdf(hit);
  const Frame frame(hit.n_shading, hit.dp_du);
  const Vec3 wo = frame.to_local(-path.ray.d);
  const float u = sampler.rng().next_float();
  const int most = scatterings_after(path.depth + 1);
  std::optional<LightPathSet::Choice> choice;
  if (bsdf.is_diffuse()) {
    const Vec3 n = wo.z > 0.0f ? frame.n : -frame.n;
    const auto seen = [&](const Lanes& x, const Lanes& y, const Lanes& z) {
      const Lanes value = max(n.x * x + n.y * y + n.z * z, Lanes(0.0f)) / kPi;
      return LightPathSet::Seen{value, value};
    };
    choice = path.light->choose(path.bundle, hit.p, most, seen, u);
  } else if (const auto lobe = bsdf.mirror_lobe()) {
    const Vec3 mirrored = glm::reflect(path.ray.d, hit.n_shading);
    const auto seen = [&](const Lanes& x, const Lanes& y, const Lanes& z) {
      const Lanes value =
          LightPathSet::henyey_greenstein(*lobe, mirrored.x * x + mirrored.y * y + mirrored.z * z);
      return LightPathSet::Seen{value, value};
    };
    choice = path.light->choose(path.bundle, hit.p, most, seen, u);
  } else {
    const auto seen = [&](const Lanes& x, const Lanes& y, const Lanes& z) {
      LightPathSet::Seen s;
      for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
        const Vec3 wi = frame.to_local({x[lane], y[lane], z[lane]});
        s.value[lane] = luminance(bsdf.eval(wo, wi, hit.uv));
        s.pdf[lane] = bsdf.pdf(wo, wi, hit.uv);
      }
      return s;
    };
    choice = path.light->choose(path.bundle, hit.p, most, seen, u);
  }
  if (!choice) return;
  const float distance = glm::distance(choice->vertex->p, hit.p);
  const Vec3 d = (choice->vertex->p - hit.p) / distance;
  const Vec3 wi = frame.to_local(d);
  if (!is_same_side(wi, d, hit)) return;
  const float share = light_paths_->light_share(distance, bsdf.pdf(wo, wi, hit.uv));
  meet(path, hit.leave(d), *choice, scene_.medium_toward(hit, -path.ray.d, d, path.medium),
       path.beta * bsdf.eval(wo, wi, hit.uv), share, path.depth + 1, sampler);
}

void PathIntegrator::meet(Path& path, const Ray& ray, const LightPathSet::Choice& choice,
                          const Medium* medium, const Rgb& beta, float share, int scatterings,
                          Sampler& sampler) const {
  const LightVertex& vertex = *choice.vertex;
  const Toward toward(
      ray.o, vertex.hit ? vertex.hit->point().end_of_ray_from(ray.o) : glm::dvec3(vertex.p));
  if (!(toward.distance > 0.0)) return;
  const Rgb T =
      scene_.transmittance({ray.o, toward.d}, float(toward.distance), medium, sampler.rng());
  // Their product first: in tiny scenes one is near the largest float and the other near the least.
  const Rgb light = vertex.power * light_paths_->reach_squared();
  gather(path,
         beta * T * light * scattered_toward(scene_, vertex, -ray.d) * (choice.weight * share),
         scatterings + vertex.scatterings);
}

PhaseSample PathIntegrator::next_direction(const Path& path, const FreeFlight& flight,
                                           Sampler& sampler) const {
  if (!flight.scattered) {
    sampler.skip_2d();
    return {};
  }
  const PhaseSample next = flight.phase.sample(path.ray.d, sampler.next_2d());
  medium_around(path).prefetch({path.ray.at(flight.t), next.d});
  return next;
}

bool PathIntegrator::scatter_in_medium(Path& path, const Segment& segment, const FreeFlight& flight,
                                       const PhaseSample& next, Sampler& sampler) const {
  see_first(path, flight);
  if (!may_scatter(path)) return false;
  ++path.depth;
  const Vec3 p = path.ray.at(flight.t);
  const bool meets = path.light != nullptr && !flight.phase.is_delta();
  if (meets) {
    path.beta *= left_by_light_paths(path, p, sampler);
    if (is_black(path.beta)) return false;
    meet_light_paths(path, p, flight.phase, sampler);
  }
  path.ray = {p, next.d};
  path.t_max = kInfinity;
  path.vertex = p;
  path.pdf_dir = next.pdf;
  path.pdf_met = meets ? next.pdf : 0.0f;
  path.segment = segment;
  path.t_vertex = flight.t;
  return true;
}

bool PathIntegrator::interact_with_surface(Path& path, const Hit& hit, Sampler& sampler) const {
  const Bsdf& bsdf = scene_.bsdf(hit);
  const Frame frame(hit.n_shading, hit.dp_du);
  const Vec3 wo = frame.to_local(-path.ray.d);

  // Light paths know nothing of what leaves by a Dirac lobe.
  const bool meets = path.light != nullptr && bsdf.has_smooth_lobe();
  const Rgb beta = path.beta;
  if (meets) path.beta *= left_by_light_paths(path, hit.p, sampler);
  if (bsdf.has_smooth_lobe() && may_scatter(path) && !is_black(path.beta)) {
    light_surface(path, hit, path.beta, sampler);
    if (meets) meet_light_paths(path, hit, sampler);
  }

  const float u_lobe = sampler.next_1d();
  const auto next = bsdf.sample(wo, hit.uv, u_lobe, sampler.next_2d());
  if (!next || is_black(next->weight)) return false;
  const bool is_dirac = !(next->pdf < kInfinity);
  if (is_dirac) path.beta = beta;
  if (is_black(path.beta)) return false;

  if (next->straight) {
    path.beta *= next->weight;
    path.medium = scene_.medium_across(hit, path.ray.d, path.medium);
    path.ray = hit.leave(path.ray.d);
    path.t_max -= hit.t;
    path.t_first += hit.t;
    return true;
  }

  if (!std::isfinite(path.first.depth)) {
    path.first.depth = path.t_first + hit.t;
    path.first.albedo = bsdf.albedo(hit.uv);
  }
  if (!may_scatter(path)) return false;
  ++path.depth;
  const Vec3 d = frame.to_world(next->wi);
  if (!is_same_side(next->wi, d, hit)) return false;
  path.beta *= next->weight;
  path.medium = scene_.medium_toward(hit, -path.ray.d, d, path.medium);
  path.ray = hit.leave(d);
  path.t_max = kInfinity;
  path.vertex = hit.p;
  path.pdf_dir = next->pdf;
  path.pdf_met = meets && !is_dirac ? next->pdf : 0.0f;
  path.segment.medium = nullptr;
  path.eta_squared *= next->eta * next->eta;
  return true;
}

void PathIntegrator::add_emission(Path& path, const Hit& hit, Sampler& sampler) const {
  if (path.depth == 0 && settings_.hide_emitters) return;
  const auto emission = scene_.emission(path.vertex, hit, path.ray.d);
  if (!emission) return;
  // The light that crosses the medium, rather than the chance that the path does.
  const Rgb T = path.medium == nullptr
                    ? Rgb{1.0f}
                    : medium_around(path).transmittance(path.ray, hit.t, sampler.rng());
  const float p_choice = scene_.lights().probability(path.vertex, emission->light);
  const float pdf_light = emission->pdf * light_choice(path, emission->light, p_choice);
  gather(path, path.beta * T * emission->L * power_heuristic(path.pdf_dir, pdf_light), path.depth);
}

void PathIntegrator::add_environment(Path& path) const {
  const LightSet& lights = scene_.lights();
  const EnvironmentLight::View view = lights.environment_view(path.vertex, path.ray.d);
  const float pdf_light = view.pdf * light_choice(path, lights.size(), 1.0f);
  gather(path, path.beta * view.L * power_heuristic(path.pdf_dir, pdf_light), path.depth);
}

float PathIntegrator::light_choice(const Path& path, std::size_t light, float p_choice) const {
  if (path.segment.medium == nullptr) return p_choice;
  return SegmentLighting(scene_.lights(), path.segment).choice(light, path.t_vertex, p_choice);
}

bool PathIntegrator::survives_roulette(Path& path, Sampler& sampler) const {
  const bool is_tried_later = path.pdf_met > 0.0f;  // by what light paths leave to it
  if ((path.depth < settings_.rr_depth || is_tried_later) && path.segments < kLongPath) return true;
  float p_survive = std::min(std::sqrt(max_component(path.beta) * path.eta_squared), 1.0f);
  // A path that loses nothing may wander for long. Of those in a thick body a share that falls as
  // n^-1.5 leaves it after n flights. Survival that falls as n^-k lets squared weights grow with
  // the sum of n^(k - 1.5) over all lengths, and time with that of n^(-0.5 - k): at k = 0.5 both
  // grow with the logarithm of the longest path alone. Where there is no way out, time grows with
  // the sum of n^-k, which ends for k > 1 only.
  if (path.segments >= kLongPath) {
    const float k = path.segments < kLostPath ? 0.5f : 1.5f;
    p_survive = std::min(p_survive, 1.0f - k / float(path.segments));
  }
  if (!(sampler.next_1d() < p_survive)) return false;
  path.beta /= p_survive;
  return true;
}

}  // namespace brume
