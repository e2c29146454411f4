// SPDX-License-Identifier: Apache-2.0
#include "app/trade_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/recommendation.h"

namespace brume {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json();
}

Json interval(const Estimate& estimate) {
  return {{"value", number(estimate.value)}, {"interval_95", number(estimate.error)}};
}

Json trial_json(const TrialResult& r, const ReportInfo& info) {
  return {{"setting", r.trial.name},
          {"group", r.trial.group},
          {"options", r.trial.options},
          {"biased", r.trial.biased},
          {"spp", r.spp},
          {"seeds", r.seeds},
          {"seconds", number(r.seconds)},
          {"seconds_full_size", number(info.scale() * r.seconds)},
          {"relative_squared_error", interval(r.accuracy.squared_error)},
          {"relative_squared_bias", interval(r.accuracy.squared_bias)},
          {"relative_mean_bias", interval(r.accuracy.mean_bias)},
          {"relative_variance", number(r.accuracy.variance)},
          {"memory_bytes", r.memory_bytes}};
}

}  // namespace

std::string trade_json(const Study& study, const ReportInfo& info) {
  Json json = {{"version", info.version},
               {"input", info.input},
               {"command", info.command},
               {"threads", info.threads},
               {"budget_seconds", info.budget},
               {"seconds", info.seconds},
               {"width", info.size.x},
               {"height", info.size.y},
               {"full_width", info.full_size.x},
               {"full_height", info.full_size.y},
               {"complete", study.complete},
               {"reference_radiance", study.reference.radiance},
               {"reference_spp", study.reference_spp ? Json(2 * *study.reference_spp) : Json()},
               {"settings", Json::array()},
               {"recommendations", Json::array()},
               {"skipped", study.skipped}};
  for (const TrialResult& result : study.results)
    json["settings"].push_back(trial_json(result, info));
  for (const Recommendation& r : recommend(study.results))
    json["recommendations"].push_back(
        {{"relative_rmse", r.target},
         {"setting", study.results[r.trial].trial.name},
         {"options", study.results[r.trial].trial.options},
         {"spp", r.spp},
         {"seconds_full_size", number(info.scale() * r.seconds)},
         {"seconds_full_size_default", number(info.scale() * r.default_seconds)}});
  return json.dump(2) + "\n";
}

}  // namespace brume
