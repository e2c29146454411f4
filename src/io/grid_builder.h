// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the volume readers of this folder, see grid_file.h.

#include <openvdb/Grid.h>

#include <memory>
#include <string>

#include "io/vol_file.h"
#include "io/volume_file.h"

namespace brume {

/// Checks and cleans a grid of any type with one channel (`Value` float) or three (Rgb) and makes
/// it ready to render, as `load_scalar_grid` promises. `label` begins every message: the file and
/// the grid in it. Uses up `source`.
template <class Value>
std::shared_ptr<const Grid<Value>> build_grid(openvdb::GridBase::Ptr source,
                                              const std::string& label,
                                              const VolumeRequest& request, Notices& notices);

/// The same for a dense volume with the right number of channels.
template <class Value>
std::shared_ptr<const Grid<Value>> build_grid(const VolHeader& vol, const NextLayers& next_layers,
                                              const VolumeRequest& request, Notices& notices);

}  // namespace brume
