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
    case StopReason::kInterrupted:
      return "interrupted";
  }
  return {};
}

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
      {"render_seconds", statistics.result.seconds},
      {"min_spp", statistics.result.min_spp},
      {"mean_spp", statistics.result.mean_spp},
      {"bad_samples", statistics.bad_samples ? statistics.bad_samples->count : 0},
      {"biased_settings", nlohmann::json::array()},
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
