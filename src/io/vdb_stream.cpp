// SPDX-License-Identifier: Apache-2.0
#include "io/vdb_stream.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace brume {

VdbStream::VdbStream(const std::string& path)
    : stream_(path, std::ios::binary), size_(std::int64_t(std::filesystem::file_size(path))) {
  stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
}

std::string VdbStream::read_string() {
  const std::uint32_t length = read<std::uint32_t>();
  std::string text(std::size_t(checked_length(length)), '\0');
  if (!text.empty()) stream_.read(text.data(), std::streamsize(text.size()));
  return text;
}

void VdbStream::skip_metadata() {
  const auto count = read<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    read_string();                // name
    read_string();                // type
    skip(read<std::uint32_t>());  // value
  }
}

std::int64_t VdbStream::checked_length(std::int64_t length) {
  if (length > size_ - position())
    throw std::runtime_error(
        fmt::format("a block of {} bytes where {} are left", length, size_ - position()));
  return length;
}

}  // namespace brume
