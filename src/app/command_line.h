// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "app/options.h"

namespace brume {

/// The command line ended the program itself, by `--help`, `--version` or a mistake.
struct Done {
  int exit_code;
};

/// Prints help to stdout and mistakes to stderr.
std::variant<RenderOptions, InfoOptions, CompareOptions, TradeOptions, Done> parse_command_line(
    int argc, char** argv);

}  // namespace brume
