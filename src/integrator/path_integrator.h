// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.h"
#include "core/sampler.h"
#include "film/camera_sample.h"
#include "integrator/camera_medium.h"
#include "integrator/light_paths.h"
#include "integrator/path_settings.h"
#include "integrator/segment_lighting.h"
#include "scene/scene.h"

namespace brume {

/// Unbiased volumetric path tracing with next-event estimation and multiple importance sampling
/// at surfaces and in media, and Russian roulette. Index-matched boundaries are crossed by paths
/// and shadow rays alike.
class PathIntegrator {
 public:
  /// `scene` and `camera` must outlive the integrator.
  PathIntegrator(const Scene& scene, const Camera& camera, const PathSettings& settings);

  /// One sample of the light that reaches the camera at `film` in [0, 1]^2, from the top left.
  /// Samples with the same `shared` and the same place in their block share light paths.
  CameraSample sample(const Vec2& film, Sampler& sampler, const LightPaths::Key& shared) const;
  /// One that shares light paths with those of the same block in all other pixels.
  CameraSample sample(const Vec2& film, Sampler& sampler) const {
    return sample(film, sampler, LightPaths::Key{.seed = sampler.block_seed(), .group = 0});
  }

  /// Whether there are light paths to share. They cost little only where pixels ask for those
  /// of one turn before those of the next.
  bool meets_light_paths() const { return light_paths_ != nullptr; }

 private:
  struct Path;

  /// Follows a path from the camera, in `medium`, until it leaves the scene or ends. What stands
  /// behind everything is not part of what it gathers.
  Path trace(const CameraRay& camera_ray, const Medium* medium, Sampler& sampler,
             const LightPaths::Key& shared) const;

  /// Goes on with a path until it leaves the scene or ends.
  void follow(Path& path, Sampler& sampler) const;

  /// The camera's flight along `segment` both scatters and passes: follows paths that scatter and
  /// leaves `path` with the light that passes, or black. Whether this can be done: it needs a
  /// medium in closed form. Light that scatters and light that does not are thus both found by each
  /// sample, as in the forced collisions of Villemin et al. 2018.
  bool split(Path& path, Segment segment, Sampler& sampler) const;
  /// Adds to `path` the light of another path, which scatters where `flight` did.
  void follow_scattered(Path& path, const Segment& segment, const FreeFlight& flight,
                        Sampler& sampler) const;
  /// Notes what the path meets first, if nothing was before.
  void see_first(Path& path, const FreeFlight& flight) const;

  /// Roughly the radiance of light that scattered on its way to the camera, as luminance
  /// [W/(m^2 sr)]; 0 if none was found.
  float learn_scattered_luminance() const;
  /// What stands behind everything may be seen through the estimate of the transmittance T, or by
  /// the path that meets nothing. Where that is half of the paths, say, and the others bring home
  /// light that scattered, the sum of both varies little if the two are equally bright and the same
  /// path decides between them. This is the part c of the background L that is left to the path:
  /// of a sample's variance, T (1 - T) (c L - S)^2 depends on it, where S is the radiance that
  /// scattered, so that c = S / L. 0 where the background is black: others will be put there, and
  /// want the opacity from the estimate, which varies least.
  float share_of_escape(const Rgb& background) const;

  void light_segment(Path& path, const Segment& segment, const FreeFlight& flight,
                     Sampler& sampler) const;
  void light_surface(Path& path, const Hit& hit, const Rgb& beta, Sampler& sampler) const;
  void connect(Path& path, const Vec3& p, const LightSample& light, const Rgb& beta, float value,
               Sampler& sampler) const;

  void meet_light_paths(Path& path, const Vec3& p, const HenyeyGreenstein& phase,
                        Sampler& sampler) const;
  void meet_light_paths(Path& path, const Hit& hit, Sampler& sampler) const;
  /// Adds the light of a chosen vertex that goes along `ray`; `share` as of
  /// LightPaths::light_share, `beta` without it.
  void meet(Path& path, const Ray& ray, const LightPathSet::Choice& choice, const Medium* medium,
            const Rgb& beta, float share, int scatterings, Sampler& sampler) const;
  /// Roulette by what light paths leave to the path of the light that comes from `p`, where it is
  /// about to scatter: 0 where that ends here, or else its weight.
  float left_by_light_paths(const Path& path, const Vec3& p, Sampler& sampler) const;

  /// Where the path goes on if it scatters. It is asked for before light is looked for, so that
  /// what the medium reads along the next flight arrives meanwhile.
  PhaseSample next_direction(const Path& path, const FreeFlight& flight, Sampler& sampler) const;

  // Each returns whether the path goes on.
  bool scatter_in_medium(Path& path, const Segment& segment, const FreeFlight& flight,
                         const PhaseSample& next, Sampler& sampler) const;
  bool interact_with_surface(Path& path, const Hit& hit, Sampler& sampler) const;
  bool survives_roulette(Path& path, Sampler& sampler) const;

  bool may_scatter(const Path& path) const;
  bool seeks_lights(const Path& path, const Medium& around, float t_end) const;
  /// How often light may have scattered that scatters so often from there on to the camera.
  int scatterings_after(int scatterings) const;
  /// Whether light that has scattered so often is handed to the similar media.
  bool is_diffuse(int scatterings) const;
  /// The medium around the path, which must not be in vacuum, as its light sees it.
  const Medium& medium_around(const Path& path) const;
  /// Adds light that has scattered so often on its way.
  void gather(Path& path, const Rgb& L, int scatterings) const;
  void add_emission(Path& path, const Hit& hit, Sampler& sampler) const;
  void add_environment(Path& path) const;
  float light_choice(const Path& path, std::size_t light, float p_choice) const;

  const Scene& scene_;
  const Camera& camera_;
  PathSettings settings_;
  CameraMedium camera_medium_;
  std::unique_ptr<const LightPaths> light_paths_;  // null: none
  float scattered_luminance_ = 0.0f;               // [W/(m^2 sr)]
};

}  // namespace brume
