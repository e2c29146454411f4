// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanovdb/NanoVDB.h>

#include <cstdint>

namespace brume {

/// Makes a NanoVDB grid of unknown origin safe to walk: throws std::runtime_error when a node, a
/// tile table or a count reaches outside the `size` bytes of the buffer, and detaches its blind
/// data, which brume does not use. `expected` is a scalar or vector type that brume can render.
void make_sound(std::uint8_t* data, std::uint64_t size, nanovdb::GridType expected);

}  // namespace brume
