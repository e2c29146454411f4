// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <pcg_random.hpp>

#include "core/vec.h"

namespace brume {

/// Stream of independent uniform numbers, PCG32 (O'Neill 2014). Two seeds give two unrelated
/// streams; the same seed gives the same stream on every machine.
class Rng {
 public:
  explicit Rng(std::uint64_t seed, std::uint64_t stream = 0) : generator_(seed, stream) {}

  std::uint32_t next_uint() { return generator_(); }

  /// Uniform in [0, 1), on the grid of 2^-24: 1 is never returned.
  float next_float() { return static_cast<float>(generator_() >> 8) * 0x1p-24f; }
  Vec2 next_vec2() {
    const float x = next_float();
    return {x, next_float()};
  }

 private:
  pcg32 generator_;
};

}  // namespace brume
