// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options.h"

namespace CLI {
class App;
}

namespace brume {

/// Each adds its command to `app`; `options` must live until the command line has been parsed.
void add_compare(CLI::App& app, CompareOptions& options);

}  // namespace brume
