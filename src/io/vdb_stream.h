// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace brume {

/// A .vdb file being read: throws at its end instead of going on, and compares lengths with what
/// is left before it believes them.
class VdbStream {
 public:
  explicit VdbStream(const std::string& path);

  std::istream& stream() { return stream_; }
  std::int64_t size() const { return size_; }  // [bytes]
  std::int64_t position() { return std::int64_t(stream_.tellg()); }
  void seek(std::int64_t position) { stream_.seekg(position); }
  void skip(std::int64_t length) { seek(position() + checked_length(length)); }

  template <class T>
  T read() {
    T value{};
    stream_.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  }

  /// Bytes of a block whose length precedes it.
  std::string read_string();

  /// Passes over a metadata dictionary, looking only at its lengths.
  void skip_metadata();

  /// Throws unless `length` bytes are left.
  std::int64_t checked_length(std::int64_t length);

 private:
  std::ifstream stream_;
  std::int64_t size_;
};

/// Bytes of one value: in memory, and as stored in nodes, where it may be half floats.
struct ValueLayout {
  int full, stored;
};

/// Walks the tree that begins at the current position and throws std::runtime_error unless every
/// block of values has the length that OpenVDB is about to read: an uncompressed block that claims
/// more would overrun its memory. `compression` holds the flags of openvdb::io.
void check_tree(VdbStream& file, const ValueLayout& layout, std::uint32_t compression);

}  // namespace brume
