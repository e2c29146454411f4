// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options.h"
#include "io/scene_file.h"

namespace brume {

/// Whether `path` names a volume by its extension (.vdb, .nvdb, .vol) rather than a scene.
bool is_volume_path(const std::string& path);

/// Loads the scene or volume that the options name, with what they override. Throws an Error.
LoadedScene load_input(const RenderOptions& options, Notices& notices);

/// Prints each notice as a line of stderr; only warnings if `quiet`.
void print_notices(const Notices& notices, bool quiet);

}  // namespace brume
