// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the volume readers of this folder, see grid_file.h.

#include <nanovdb/util/GridHandle.h>
#include <openvdb/openvdb.h>

namespace brume {

/// Copies a tree into a NanoVDB grid without statistics, checksum or transform, and takes it apart
/// meanwhile: the two together need little more memory than one of them. Leaves `tree` without
/// leaves.
nanovdb::GridHandle<nanovdb::HostBuffer> grid_to_nano(openvdb::FloatTree& tree);
nanovdb::GridHandle<nanovdb::HostBuffer> grid_to_nano(openvdb::Vec3STree& tree);

}  // namespace brume
