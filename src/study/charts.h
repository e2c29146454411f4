// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/trade_report.h"

namespace brume {

/// Error against time of every trial on logarithmic axes, with the Pareto front, as an SVG element.
/// Trials carry their number in the table, in a circle or, where biased, in a square.
std::string error_time_chart(const Study& study, const ReportInfo& info);

/// The bias of every trial with its interval as an SVG element.
std::string bias_chart(const Study& study);

/// The legend of heat maps as an SVG element.
std::string heat_legend();

}  // namespace brume
