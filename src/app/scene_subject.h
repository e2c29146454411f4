// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "app/options.h"
#include "integrator/path_integrator.h"
#include "io/scene_file.h"
#include "study/trial.h"

namespace brume {

/// The user's scene as a study renders it: with the options of each trial.
class SceneSubject final : public Subject {
 public:
  /// `options` are of a render of the scene, its size included.
  explicit SceneSubject(const RenderOptions& options) : options_(options) {}

  void prepare(const Trial& trial) override;
  Rendered render(std::uint32_t spp, std::uint64_t seed) override;
  std::size_t memory_bytes() const override;

 private:
  RenderOptions options_;
  RenderOptions current_{};
  std::optional<LoadedScene> loaded_{};
  std::unique_ptr<const PathIntegrator> integrator_{};
};

/// Throws an Error when an option of a trial is not one of `brume render` that studies change.
void apply_trial(const Trial& trial, RenderOptions& options);

}  // namespace brume
