// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/render.h"

namespace brume {

class Film;

/// What a render is of, as names and values in words: renders for which all are the same have the
/// same bits after the same samples.
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

/// Puts all that a render needs in order to go on into a file, which replaces an older one whole or
/// not at all. Throws Error naming the path and the reason.
void write_checkpoint(const std::string& path, const Fingerprint& fingerprint,
                      const RenderState& state, Film& film);

/// Fills `film`, which has the size and layers of the one that was written. Throws an input Error
/// that says what differs when the checkpoint is of another render, or what is wrong when it is
/// damaged; the film is not to be used then.
RenderState read_checkpoint(const std::string& path, const Fingerprint& fingerprint, Film& film);

}  // namespace brume
