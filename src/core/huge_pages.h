// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace brume {

/// Asks for pages of 2 MB under memory that has not been written yet, as far as it is large enough
/// for them. What is read at random places otherwise needs a walk through the tables of small pages
/// at nearly every read. Where the wish is not granted, nothing is lost.
inline void prefer_huge_pages(void* memory, std::size_t bytes) {
  constexpr std::uintptr_t kPage = std::uintptr_t(1) << 21;  // [byte]
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kPage - 1) & ~(kPage - 1);
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(kPage - 1);
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  explicit HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}

  T* allocate(std::size_t n) {
    void* const memory = ::operator new(n * sizeof(T));
    prefer_huge_pages(memory, n * sizeof(T));
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*n*/) { ::operator delete(memory); }

  bool operator==(const HugePageAllocator&) const { return true; }
};

/// A table that is read at random places.
template <class T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace brume
