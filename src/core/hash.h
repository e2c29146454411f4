// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace brume {

/// Mixes all 64 bits; a bijection (Stafford 2011, variant 13, the finaliser of SplitMix64).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Hash of two words; the order matters.
constexpr std::uint64_t hash_combine(std::uint64_t a, std::uint64_t b) {
  return mix_bits(a + 0x9e3779b97f4a7c15ULL + mix_bits(b + 0x9e3779b97f4a7c15ULL));
}

}  // namespace brume
