// SPDX-License-Identifier: Apache-2.0
#include "app/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/estimator_settings.h"

namespace brume {
namespace {

/// What a scene must hold for a setting to make a difference.
enum class Needs { kAny, kMedia, kScattering, kGrids };

struct Candidate {
  const char* group;
  const char* setting;
  Needs needs;
};
constexpr Candidate kCandidates[] = {
    {"sampling", "sampler=independent", Needs::kAny},
    {"sampling", "near-lights=off", Needs::kScattering},
    {"sampling", "shadow-roulette=off", Needs::kScattering},
    {"tracking", "bounds=global", Needs::kGrids},
    {"tracking", "control=off", Needs::kGrids},
    {"tracking", "textbook", Needs::kMedia},
    {"lookup", "lookup=trilinear", Needs::kGrids},
    {"lookup", "lookup=nearest", Needs::kGrids},
    {"storage", "storage=half", Needs::kGrids},
    {"storage", "storage=8bit", Needs::kGrids},
    {"marching", "march=1", Needs::kGrids},
    {"marching", "march=4", Needs::kGrids},
    {"marching", "march=16", Needs::kGrids},
    {"similarity", "similarity=1", Needs::kScattering},
    {"similarity", "similarity=4", Needs::kScattering},
    {"similarity", "similarity=16", Needs::kScattering},
};

bool requires_machinery(const LoadedScene& scene, std::string_view machinery) {
  const auto& list = scene.scene->requirements();
  return std::any_of(list.begin(), list.end(),
                     [&](const Requirement& r) { return r.required && r.machinery == machinery; });
}

bool has(const LoadedScene& scene, Needs needs) {
  switch (needs) {
    case Needs::kAny:
      return true;
    case Needs::kMedia:
      return requires_machinery(scene, "media");
    case Needs::kScattering:
      return requires_machinery(scene, "scattering in media");
    case Needs::kGrids:
      return requires_machinery(scene, "null-collision tracking");
  }
  return false;
}

Trial setting_trial(const char* group, const std::string& assignment) {
  EstimatorSettings settings;
  apply_setting(assignment, settings);
  return {.name = assignment,
          .group = group,
          .options = {"--set", assignment},
          .biased = !biased_settings(settings).empty()};
}

}  // namespace

std::vector<Trial> design_trials(const LoadedScene& scene) {
  std::vector<Trial> trials = {{.name = "default", .group = "default"}};
  for (const std::uint32_t spp : {16u, 64u, 256u})
    trials.push_back({.name = fmt::format("{} samples", spp), .group = "samples", .spp = spp});
  for (const int depth : {2, 4, 8, 16, 32})
    if (scene.path.max_depth < 0 || depth < scene.path.max_depth)
      trials.push_back({.name = fmt::format("max depth {}", depth),
                        .group = "depth",
                        .options = {"--max-depth", std::to_string(depth)},
                        .biased = true});
  for (const Candidate& candidate : kCandidates)
    if (has(scene, candidate.needs))
      trials.push_back(setting_trial(candidate.group, candidate.setting));
  return trials;
}

std::vector<Trial> design_clamping_trials(double radiance) {
  std::vector<Trial> trials;
  for (const double factor : {1.0, 10.0})
    trials.push_back(setting_trial("clamping", fmt::format("clamp={:.3g}", factor * radiance)));
  return trials;
}

}  // namespace brume
