// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options.h"

namespace brume {

/// Exit code of the program when an interrupt ended the render and what was rendered is saved.
inline constexpr int kExitInterrupted = 130;

/// Each returns the program's exit code, or throws Error.
int run_render(const RenderOptions& options);
int run_info(const InfoOptions& options);
int run_compare(const CompareOptions& options);
int run_trade(const TradeOptions& options);

}  // namespace brume
