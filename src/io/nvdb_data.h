// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <istream>

namespace brume {

/// How the grids of a .nvdb file are packed (NanoVDB 32, util/IO.h).
enum class NvdbCodec : std::uint16_t { kNone = 0, kZip = 1, kBlosc = 2 };

/// Unpacks the first `size` bytes of a grid that `packed_size` bytes of the stream from here hold.
/// Whatever these are, nothing beyond them is read and nothing beyond `size` is written; throws
/// std::runtime_error when they hold no such grid. `whole_size` is that of the whole grid.
void unpack_nvdb(std::istream& stream, NvdbCodec codec, std::uint64_t packed_size,
                 std::uint64_t whole_size, std::uint8_t* out, std::uint64_t size);

}  // namespace brume
