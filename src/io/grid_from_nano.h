// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the volume readers of this folder, see grid_file.h.

#include <openvdb/Grid.h>

#include <cstdint>

#include "io/consumable_buffer.h"

namespace brume {

/// Builds an OpenVDB grid from a NanoVDB grid of unknown origin, which lies `offset` bytes into
/// `data`, aligned for one, and has `size`; consumes what it read. Whatever the bytes are, this
/// ends, within memory in proportion to them: offsets, counts and keys are checked before they are
/// followed, and std::runtime_error says what is wrong. Where nodes lie in space follows from the
/// tree alone; bounding boxes, statistics and blind data are not read. `type` is the
/// nanovdb::GridType that the file's header gives, as a number.
openvdb::GridBase::Ptr grid_from_nano(ConsumableBuffer& data, std::uint64_t offset,
                                      std::uint64_t size, std::uint32_t type);

}  // namespace brume
