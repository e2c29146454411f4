// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace brume {

/// Memory whose parts go back to the system one after the other, as soon as they have been read:
/// what is made of them needs the room. Aligned to a page.
class ConsumableBuffer {
 public:
  /// Throws std::bad_alloc.
  explicit ConsumableBuffer(std::uint64_t size);
  ~ConsumableBuffer();
  ConsumableBuffer(const ConsumableBuffer&) = delete;
  ConsumableBuffer& operator=(const ConsumableBuffer&) = delete;

  std::uint8_t* data() { return data_; }
  std::uint64_t size() const { return size_; }  // [bytes]

  /// Says that these bytes, which were not consumed before, are no longer needed. They keep their
  /// values until all others around them are consumed too, and are 0 then.
  void consume(std::uint64_t position, std::uint64_t bytes);

 private:
  static constexpr std::uint64_t kChunk = 1 << 16;  // [bytes], whole pages

  std::uint64_t size_;
  std::uint8_t* data_;
  std::vector<std::uint32_t> consumed_;  // bytes of each chunk
};

}  // namespace brume
