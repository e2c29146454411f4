// SPDX-License-Identifier: Apache-2.0
#include "io/consumable_buffer.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>

namespace brume {

ConsumableBuffer::ConsumableBuffer(std::uint64_t size)
    : size_(size), consumed_(size / kChunk) {  // a last part of a chunk stays to the end
  // No mapping is empty.
  void* memory = ::mmap(nullptr, std::max<std::uint64_t>(size, 1), PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::uint8_t*>(memory);
}

ConsumableBuffer::~ConsumableBuffer() {
  ::munmap(data_, std::max<std::uint64_t>(size_, 1));
}

void ConsumableBuffer::consume(std::uint64_t position, std::uint64_t bytes) {
  const std::uint64_t end = position + bytes;
  while (position < end) {
    const std::uint64_t chunk = position / kChunk, next = std::min(end, (chunk + 1) * kChunk);
    if (chunk < consumed_.size()) {
      consumed_[chunk] += std::uint32_t(next - position);
      if (consumed_[chunk] == kChunk) ::madvise(data_ + chunk * kChunk, kChunk, MADV_DONTNEED);
    }
    position = next;
  }
}

}  // namespace brume
