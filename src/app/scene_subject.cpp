// SPDX-License-Identifier: Apache-2.0
#include "app/scene_subject.h"

#include <cassert>
#include <ctime>

#include "app/camera_samples.h"
#include "app/input.h"
#include "film/develop.h"
#include "film/film.h"
#include "render/render.h"

namespace brume {
namespace {

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace

void apply_trial(const Trial& trial, RenderOptions& options) {
  for (std::size_t i = 0; i + 1 < trial.options.size(); i += 2) {
    if (trial.options[i] == "--set")
      apply_setting(trial.options[i + 1], options.settings);
    else
      options.max_depth = std::stoi(trial.options[i + 1]);
  }
}

void SceneSubject::prepare(const Trial& trial) {
  RenderOptions options = options_;
  apply_trial(trial, options);
  // Media are built with the settings of tracking; the others need no loading.
  if (!loaded_ || !(media_settings(options.settings) == media_settings(current_.settings))) {
    loaded_.reset();  // two scenes need not fit into memory
    integrator_.reset();
    Notices ignored;  // said when the scene was loaded first
    loaded_ = load_input(options, ignored);
  }
  current_ = options;
  PathSettings path = loaded_->path;
  path.lighting = options.settings.lighting;
  path.approximations = options.settings.approximations;
  if (options.max_depth) path.max_depth = *options.max_depth;
  integrator_ = std::make_unique<const PathIntegrator>(*loaded_->scene, *loaded_->camera,
                                                       suited_to(loaded_->film, path));
}

Subject::Rendered SceneSubject::render(std::uint32_t spp, std::uint64_t seed) {
  assert(integrator_ != nullptr);
  Film film(std::uint32_t(loaded_->film.crop_size.x), std::uint32_t(loaded_->film.crop_size.y));
  const bool independent = current_.settings.numbers == EstimatorSettings::Numbers::kIndependent;
  const double begin = processor_seconds();
  brume::render(camera_samples(*integrator_, loaded_->film, seed, {.independent = independent}),
                {.spp = spp, .threads = options_.threads}, film);
  const double seconds = (processor_seconds() - begin) / options_.threads;
  return {.picture = develop(film), .seconds = seconds};
}

std::size_t SceneSubject::memory_bytes() const {
  std::size_t sum = 0;
  for (const Requirement& requirement : loaded_->scene->requirements())
    sum += requirement.memory_bytes;
  return sum;
}

}  // namespace brume
