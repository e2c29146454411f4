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
struct FileHeader {
  char magic[3];
  std::uint8_t version;
  std::int32_t encoding;
  std::int32_t resolution[3];
  std::int32_t channels;
  float box[6];
};
static_assert(sizeof(FileHeader) == 48);

struct Encoding {
  const char* name;
  int bytes;
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

}  // namespace

VolReader::VolReader(std::string path)
    : path_(std::move(path)),
      stream_(path_, std::ios::binary),
      file_bytes_(std::filesystem::file_size(path_)) {
  FileHeader file{};
  if (!stream_.read(reinterpret_cast<char*>(&file), sizeof file))
    throw Error(fmt::format("{}: truncated: a .vol header has {} bytes, the file {}", path_,
                            sizeof file, file_bytes_));
  if (file.version != 3)
    throw Error(
        fmt::format("{}: .vol version {} is not supported; expected 3", path_, file.version));
  const Encoding encoding = encoding_of(file.encoding, path_);
  const glm::ivec3 n(file.resolution[0], file.resolution[1], file.resolution[2]);
  if (n.x < 1 || n.y < 1 || n.z < 1)
    throw Error(fmt::format("{}: .vol resolution {} x {} x {}; expected at least 1 on each axis",
                            path_, n.x, n.y, n.z));
  if (file.channels != 1 && file.channels != 3)
    throw Error(fmt::format("{}: .vol with {} channels; expected 1 or 3", path_, file.channels));

  // In double: the product of four 31-bit numbers overflows any integer.
  const double expected =
      double(sizeof file) + double(n.x) * n.y * n.z * file.channels * double(encoding.bytes);
  if (expected > double(file_bytes_))
    throw Error(fmt::format(
        "{}: truncated: {} x {} x {} voxels of {} {} values take {:.0f} bytes, the file has {}",
        path_, n.x, n.y, n.z, file.channels, encoding.name, expected, file_bytes_));

  header_ = {.resolution = n,
             .channels = file.channels,
             .box_min = {file.box[0], file.box[1], file.box[2]},
             .box_max = {file.box[3], file.box[4], file.box[5]},
             .value_type = encoding.name,
             .bytes = std::uint64_t(expected)};
  bytes_of_value_ = encoding.bytes;
}

std::vector<float> VolReader::read_layers(int count) {
  std::vector<float> values(std::size_t(header_.resolution.x) * std::size_t(header_.resolution.y) *
                            std::size_t(header_.channels) * std::size_t(count));
  const std::size_t bytes = values.size() * std::size_t(bytes_of_value_);
  char* const packed = reinterpret_cast<char*>(values.data());
  if (!stream_.read(packed, std::streamsize(bytes)))
    throw Error(fmt::format("{}: could not be read to its end", path_), ErrorKind::kEnvironment);
  if (bytes_of_value_ == sizeof(float)) return values;
  // Widened where they are: the last first, lest one be written over another that is still packed.
  for (std::size_t i = values.size(); i-- > 0;) {
    if (bytes_of_value_ == 2) {
      std::uint16_t bits;
      std::memcpy(&bits, packed + 2 * i, 2);
      openvdb::math::half half;
      half.setBits(bits);
      values[i] = half;
    } else {
      values[i] = float(static_cast<unsigned char>(packed[i])) / 255.0f;
    }
  }
  return values;
}

}  // namespace brume
