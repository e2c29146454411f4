// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/trade_report.h"

namespace brume {

/// The study as a JSON text. Numbers that are not known are null.
std::string trade_json(const Study& study, const ReportInfo& info);

}  // namespace brume
