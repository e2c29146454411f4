// SPDX-License-Identifier: Apache-2.0
#include "app/statistics_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/version.h"
#include "core/error.h"

namespace brume {

std::string describe(StopReason reason) {
  switch (reason) {
    case StopReason::kSampleCount:
      return "sample count reached";
    case StopReason::kTimeLimit:
      return "time spent";
    case StopReason::kErrorTarget:
      return "error target reached";
    case StopReason::kInterrupted:
      return "interrupted";
  }
  return {};
}

namespace {

/// An object of values by name.
nlohmann::ordered_json as_json(const SettingValues& settings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : settings) json[name] = value;
  return json;
}

nlohmann::json names_of(const SettingValues& settings) {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& setting : settings) names.push_back(setting.first);
  return names;
}

}  // namespace

void write_statistics(const std::string& path, const RenderStatistics& statistics) {
  nlohmann::ordered_json json = {
      {"version", kVersion},
      {"input", statistics.input},
      {"outputs", statistics.outputs},
      {"width", statistics.size.x},
      {"height", statistics.size.y},
      {"seed", statistics.seed},
      {"stopped", describe(statistics.result.reason)},
      {"load_seconds", statistics.load_seconds},
      {"render_seconds", statistics.result.state.seconds},
      {"min_spp", statistics.result.min_spp},
      {"mean_spp", statistics.result.mean_spp},
      {"bad_samples", statistics.bad_samples ? statistics.bad_samples->count : 0},
      {"settings", as_json(changed_settings(statistics.settings))},
      {"biased_settings", names_of(biased_settings(statistics.settings))},
  };
  // JSON has no infinity: an error that is not known is null.
  const auto number = [](double x) {
    return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json();
  };
  json["relative_rms_error"] = number(statistics.error.relative_rms);
  json["relative_rms_error_bound_95"] = number(statistics.error.upper_bound);
  std::ofstream file(path);
  file << json.dump(2) << "\n";
  file.close();
  if (!file)
    throw Error(fmt::format("cannot write {}: {}", path, std::strerror(errno)),
                ErrorKind::kEnvironment);
}

}  // namespace brume
