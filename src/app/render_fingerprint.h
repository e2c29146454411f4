// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options.h"
#include "film/film.h"
#include "io/scene_file.h"
#include "render/checkpoint.h"

namespace brume {

/// Everything that the bits of a render depend on, besides how many samples it takes: the version,
/// the content of all files that were read, and the options. Reads the files once more; throws an
/// Error when one has vanished.
Fingerprint render_fingerprint(const RenderOptions& options, const LoadedScene& loaded,
                               const FilmLayers& layers);

}  // namespace brume
