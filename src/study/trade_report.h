// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "study/trade_study.h"

namespace brume {

/// What a report says about a study beside its results.
struct ReportInfo {
  std::string input;    // as on the command line
  std::string command;  // that renders it by default
  std::string version;  // of brume
  int threads;
  double budget, seconds;      // given and spent [s]
  glm::ivec2 size, full_size;  // [pixel] of the study's pictures, and of the scene's

  /// Times of the scene's own picture over those of the study's.
  double scale() const { return double(full_size.x) * full_size.y / (double(size.x) * size.y); }
};

/// One line for each trial, for people at a terminal.
std::string text_table(const Study& study, const ReportInfo& info);
/// What to do for each error, one line each.
std::string text_recommendations(const Study& study, const ReportInfo& info);

/// The results as comma-separated values with a header line.
std::string csv_report(const Study& study, const ReportInfo& info);

/// The whole report as one page that needs no other file: plots, table, pictures.
std::string html_report(const Study& study, const ReportInfo& info);

}  // namespace brume
