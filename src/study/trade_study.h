// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/trial.h"

namespace brume {

/// How a study goes on, for people: what is measured now, and how far it is.
struct StudyProgress {
  std::string activity;
  double seconds_left;
};

struct StudySettings {
  double seconds;                        // of the whole study
  std::optional<Reference> reference{};  // one of the user's; otherwise a third of the time is
                                         // spent on one
  std::function<void(const StudyProgress&)> report{};  // may be empty
  std::function<bool()> stops{};                       // may be empty; true ends the study early
};

struct Study {
  Reference reference{};
  std::optional<std::uint32_t> reference_spp{};  // of each half; nothing when it was given
  std::vector<TrialResult> results{};            // in the order of the trials, the default first
  std::vector<std::string> skipped{};            // trials that did not fit, each with the reason
  bool complete = false;                         // or stopped early
};

/// Measures speed against accuracy of each trial; the first, unbiased, is the default and makes
/// the reference. Time left is shared equally among the trials left, each of which renders several
/// pictures with seeds of their own.
Study run_study(Subject& subject, const std::vector<Trial>& trials, const StudySettings& settings);

}  // namespace brume
