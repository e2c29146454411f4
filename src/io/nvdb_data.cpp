// SPDX-License-Identifier: Apache-2.0
#include "io/nvdb_data.h"

#include <blosc.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

namespace brume {
namespace {

// Packed data comes in blocks, each preceded by its packed size: one for Zip, and one for each GB
// for Blosc.
constexpr std::uint64_t kBlock = std::uint64_t(1) << 30;  // [bytes]

[[noreturn]] void throw_damaged() {
  throw std::runtime_error("its compressed data is damaged");
}

void unzip(std::istream& stream, std::uint64_t packed_size, std::uint8_t* out, std::uint64_t size) {
  z_stream zip{};
  if (inflateInit(&zip) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closer(&zip, &inflateEnd);
  std::vector<char> piece(std::size_t(1) << 20);
  while (size > 0) {
    if (zip.avail_in == 0) {
      const auto n = std::min<std::uint64_t>(piece.size(), packed_size);
      if (n == 0) throw_damaged();
      stream.read(piece.data(), std::streamsize(n));
      packed_size -= n;
      zip.next_in = reinterpret_cast<Bytef*>(piece.data());
      zip.avail_in = uInt(n);
    }
    zip.next_out = out;
    zip.avail_out = uInt(std::min(size, kBlock));
    const uInt room = zip.avail_out;
    const int state = inflate(&zip, Z_NO_FLUSH);
    out += room - zip.avail_out;
    size -= room - zip.avail_out;
    if (state != Z_OK && !(state == Z_STREAM_END && size == 0)) throw_damaged();
  }
}

/// The first `size` bytes of a block of `block_size`.
void unblosc(const std::vector<char>& packed, std::uint64_t block_size, std::uint8_t* out,
             std::uint64_t size) {
  std::size_t expected = 0;
  if (blosc_cbuffer_validate(packed.data(), packed.size(), &expected) != 0 ||
      expected != block_size)
    throw_damaged();
  if (size == block_size) {
    if (blosc_decompress_ctx(packed.data(), out, size, /*threads=*/1) != std::int64_t(size))
      throw_damaged();
    return;
  }
  std::size_t item = 0;  // [bytes]
  int flags = 0;
  blosc_cbuffer_metainfo(packed.data(), &item, &flags);
  if (item == 0) throw_damaged();
  const std::uint64_t items = (size + item - 1) / item;
  std::vector<std::uint8_t> start(items * item);
  if (start.size() > block_size ||
      blosc_getitem(packed.data(), 0, int(items), start.data()) != std::int64_t(start.size()))
    throw_damaged();
  std::copy_n(start.begin(), size, out);
}

}  // namespace

void unpack_nvdb(std::istream& stream, NvdbCodec codec, std::uint64_t packed_size,
                 std::uint64_t whole_size, std::uint8_t* out, std::uint64_t size) {
  if (codec == NvdbCodec::kNone) {
    if (packed_size != whole_size) throw std::runtime_error("its two sizes differ");
    stream.read(reinterpret_cast<char*>(out), std::streamsize(size));
    return;
  }
  while (size > 0) {
    std::uint64_t block_packed_size = 0;
    stream.read(reinterpret_cast<char*>(&block_packed_size), sizeof block_packed_size);
    if (block_packed_size > packed_size) throw std::runtime_error("a block is too long");
    if (codec == NvdbCodec::kZip) return unzip(stream, block_packed_size, out, size);
    std::vector<char> packed(block_packed_size);
    stream.read(packed.data(), std::streamsize(packed.size()));
    const std::uint64_t block_size = std::min(whole_size, kBlock);
    const std::uint64_t wanted = std::min(size, block_size);
    unblosc(packed, block_size, out, wanted);
    out += wanted;
    size -= wanted;
    whole_size -= block_size;
  }
}

}  // namespace brume
