// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/recommendation.h"
#include "study/report_text.h"
#include "study/trade_report.h"

namespace brume {
namespace {

/// Characters that a terminal shows: "±" is two bytes and one column.
std::size_t columns_of(const std::string& text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string joined(const std::vector<std::string>& options) {
  std::string text;
  for (const std::string& option : options) text += (text.empty() ? "" : " ") + option;
  return text;
}

}  // namespace

std::string text_table(const Study& study, const ReportInfo& info) {
  std::vector<std::vector<std::string>> rows = {
      {"setting", "spp", "time", "error", "bias", "mean bias", "efficiency", "memory"}};
  for (const TrialResult& r : study.results)
    rows.push_back(
        {r.trial.name + (r.trial.biased ? " *" : ""), std::to_string(r.spp),
         duration_text(info.scale() * r.seconds), root_text(root(r.accuracy.squared_error)),
         root_text(root(r.accuracy.squared_bias)), signed_text(r.accuracy.mean_bias),
         fmt::format("{:.2f}", efficiency(r, study.results.front())), memory_text(r.memory_bytes)});
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], columns_of(row[i]));
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - columns_of(row[i]), ' ');
      text += i == 0 ? row[i] + padding : "  " + padding + row[i];
    }
    text += "\n";
  }
  return text + "* biased\n";
}

std::string text_recommendations(const Study& study, const ReportInfo& info) {
  std::string text;
  for (const Recommendation& r : recommend(study.results)) {
    const TrialResult& result = study.results[r.trial];
    text += fmt::format("for {} use {}: {} spp, {}", percent_text(r.target), result.trial.name,
                        r.spp, duration_text(info.scale() * r.seconds));
    if (r.trial != 0)
      text += fmt::format(" ({} by default)", duration_text(info.scale() * r.default_seconds));
    text += "\n";
  }
  return text;
}

std::string csv_report(const Study& study, const ReportInfo& info) {
  std::string text =
      "setting,group,options,biased,spp,seeds,seconds,seconds_full_size,relative_rmse,"
      "relative_rmse_low,relative_rmse_high,squared_bias,squared_bias_interval,mean_bias,"
      "mean_bias_interval,variance,efficiency,memory_bytes\n";
  for (const TrialResult& r : study.results) {
    const RootInterval error = root(r.accuracy.squared_error);
    text += fmt::format(
        "{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},"
        "{:.6g},{:.6g},{:.6g},{}\n",
        r.trial.name, r.trial.group, joined(r.trial.options), r.trial.biased ? "yes" : "no", r.spp,
        r.seeds, r.seconds, info.scale() * r.seconds, error.value, error.low, error.high,
        r.accuracy.squared_bias.value, r.accuracy.squared_bias.error, r.accuracy.mean_bias.value,
        r.accuracy.mean_bias.error, r.accuracy.variance, efficiency(r, study.results.front()),
        r.memory_bytes);
  }
  return text;
}

}  // namespace brume
