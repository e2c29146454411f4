// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "integrator/path_settings.h"
#include "medium/tracking_settings.h"

namespace brume {

/// How a picture is computed, as against what is in it: what `--set` changes.
struct EstimatorSettings {
  enum class Numbers { kSobol, kIndependent };

  TrackingSettings tracking{};
  LightingSettings lighting{};
  Approximations approximations{};
  Numbers numbers = Numbers::kSobol;
};

/// What media are built with.
TrackingSettings media_settings(const EstimatorSettings& settings);

/// A row of the table that help, parsing and metadata read.
struct Setting {
  std::string name;
  std::string values;    // for people: "cells, global" or "off, a number > 0 (biased)"
  std::string textbook;  // value in the textbook configuration; empty: left as it is
  std::string meaning;
  std::function<std::string(const EstimatorSettings&)> value;
  /// Whether its value may change the expected picture.
  std::function<bool(const EstimatorSettings&)> is_biased;
  /// Returns false for a word that is no value of the setting.
  std::function<bool(EstimatorSettings&, const std::string&)> assign;
};

/// All settings, in the order of help.
const std::vector<Setting>& setting_table();

/// Applies "name=value", or "textbook" for the textbook's value of every setting. Throws an Error
/// with the nearest valid name.
void apply_setting(const std::string& assignment, EstimatorSettings& settings);

/// Name and value of each setting that differs from its default.
using SettingValues = std::vector<std::pair<std::string, std::string>>;
SettingValues changed_settings(const EstimatorSettings& settings);
/// Those of them that may change the expected picture.
SettingValues biased_settings(const EstimatorSettings& settings);

}  // namespace brume
