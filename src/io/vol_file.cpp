// SPDX-License-Identifier: Apache-2.0
#include "io/vol_file.h"

#include <fmt/format.h>
#include <openvdb/Types.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace brume {
namespace {

// Layout: Mitsuba 3 documentation, plugin "gridvolume". Little-endian.
//
//     0  'V' 'O' 'L' 3      8  resolution x, y, z (int32)    24  box min, max (6 float32)
//     4  encoding (int32)  20  channels (int32)              48  values
struct Header {
  char magic[3];
  std::uint8_t version;
  std::int32_t encoding;
  std::int32_t resolution[3];
  std::int32_t channels;
  float box[6];
};
static_assert(sizeof(Header) == 48);

struct Encoding {
  const char* name;
  std::size_t bytes;
};

Encoding encoding_of(std::int32_t code, const std::string& path) {
  switch (code) {
    case 1:
      return {"float", 4};
    case 2:
      return {"half float", 2};
    case 3:
      return {"uint8", 1};
  }
  throw Error(fmt::format(
      "{}: .vol encoding {} is not supported; expected 1 (float32), 2 (float16) or 3 (uint8)", path,
      code));
}

VolFile read(const std::string& path, bool with_values) {
  std::ifstream stream(path, std::ios::binary);
  const std::uintmax_t file_size = std::filesystem::file_size(path);
  Header header{};
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof header))
    throw Error(fmt::format("{}: truncated: a .vol header has {} bytes, the file {}", path,
                            sizeof header, file_size));
  if (header.version != 3)
    throw Error(
        fmt::format("{}: .vol version {} is not supported; expected 3", path, header.version));
  const Encoding encoding = encoding_of(header.encoding, path);
  for (const std::int32_t n : header.resolution)
    if (n < 1)
      throw Error(fmt::format("{}: .vol resolution {} x {} x {}; expected at least 1 on each axis",
                              path, header.resolution[0], header.resolution[1],
                              header.resolution[2]));
  if (header.channels != 1 && header.channels != 3)
    throw Error(fmt::format("{}: .vol with {} channels; expected 1 or 3", path, header.channels));

  // In double: the product of four 31-bit numbers overflows any integer.
  const double expected = double(sizeof header) + double(header.resolution[0]) *
                                                      header.resolution[1] * header.resolution[2] *
                                                      header.channels * double(encoding.bytes);
  if (expected > double(file_size))
    throw Error(fmt::format(
        "{}: truncated: {} x {} x {} voxels of {} {} values take {:.0f} bytes, the file has {}",
        path, header.resolution[0], header.resolution[1], header.resolution[2], header.channels,
        encoding.name, expected, file_size));

  VolFile vol{.resolution = {header.resolution[0], header.resolution[1], header.resolution[2]},
              .channels = header.channels,
              .box_min = {header.box[0], header.box[1], header.box[2]},
              .box_max = {header.box[3], header.box[4], header.box[5]},
              .value_type = encoding.name,
              .values = {}};
  if (!with_values) return vol;

  const std::size_t count = std::size_t(vol.resolution.x) * std::size_t(vol.resolution.y) *
                            std::size_t(vol.resolution.z) * std::size_t(vol.channels);
  std::vector<char> bytes(count * encoding.bytes);
  if (!stream.read(bytes.data(), std::streamsize(bytes.size())))
    throw Error(fmt::format("{}: could not be read to its end", path), ErrorKind::kEnvironment);
  vol.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (encoding.bytes == 4) {
      std::memcpy(&vol.values[i], &bytes[4 * i], 4);
    } else if (encoding.bytes == 2) {
      std::uint16_t bits;
      std::memcpy(&bits, &bytes[2 * i], 2);
      openvdb::math::half half;
      half.setBits(bits);
      vol.values[i] = half;
    } else {
      vol.values[i] = float(static_cast<unsigned char>(bytes[i])) / 255.0f;
    }
  }
  return vol;
}

}  // namespace

VolFile read_vol_header(const std::string& path) {
  return read(path, false);
}
VolFile read_vol_file(const std::string& path) {
  return read(path, true);
}

}  // namespace brume
