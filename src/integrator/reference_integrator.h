// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.h"
#include "core/sampler.h"
#include "integrator/camera_medium.h"
#include "integrator/path_settings.h"
#include "scene/scene.h"

namespace brume {

/// The slow, obvious path tracer that `PathIntegrator` is held against in tests: light is found
/// by running into it. No next-event estimation, multiple importance sampling or roulette, except
/// that Dirac lights, which cannot be run into, are connected to at every event.
class ReferenceIntegrator {
 public:
  /// `scene` and `camera` must outlive the integrator.
  ReferenceIntegrator(const Scene& scene, const Camera& camera, const PathSettings& settings);

  /// One sample of the radiance that reaches the camera at `film` in [0, 1]^2, from the top left.
  Rgb sample(const Vec2& film, Sampler& sampler) const;

 private:
  Rgb dirac_light(const Vec3& p, Sampler& sampler, Vec3& d, float& distance) const;
  Rgb analog_transmittance(Ray ray, float distance, const Medium* medium, Sampler& sampler) const;

  const Scene& scene_;
  const Camera& camera_;
  PathSettings settings_;
  CameraMedium camera_medium_;
};

}  // namespace brume
