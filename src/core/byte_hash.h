// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <span>

#include "core/hash.h"

namespace brume {

/// Hash of a sequence of bytes that arrives in pieces; where they were cut does not matter. It
/// finds damage, not forgery.
class ByteHash {
 public:
  void add(std::span<const unsigned char> bytes) {
    count_ += bytes.size();
    while (!bytes.empty()) {
      if (pending_ == 0 && bytes.size() >= sizeof word_) {
        std::memcpy(&word_, bytes.data(), sizeof word_);
        hash_ = mix_bits(hash_ + word_) + 0x9e3779b97f4a7c15ULL;
        bytes = bytes.subspan(sizeof word_);
        word_ = 0;
        continue;
      }
      word_ |= std::uint64_t(bytes.front()) << (8 * pending_);
      bytes = bytes.subspan(1);
      pending_ += 1;
      if (pending_ < sizeof word_) continue;
      hash_ = mix_bits(hash_ + word_) + 0x9e3779b97f4a7c15ULL;
      word_ = 0;
      pending_ = 0;
    }
  }

  std::uint64_t value() const { return hash_combine(hash_combine(hash_, word_), count_); }

 private:
  std::uint64_t hash_ = 0, count_ = 0;
  std::uint64_t word_ = 0;   // bytes that make no whole word yet
  std::size_t pending_ = 0;  // how many
};

}  // namespace brume
