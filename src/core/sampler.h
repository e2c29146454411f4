// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/rng.h"
#include "core/vec.h"

namespace brume {

/// Random numbers of one camera sample: a pure function of (seed, pixel, sample index, dimension).
///
/// The first dimensions are Owen-scrambled Sobol points, each pair scrambled and shuffled on its
/// own (Burley 2020); the rest, and `rng()`, are a PCG stream of the sample. Samples come in
/// replications of `kReplication` consecutive indices that are scrambled independently, so that
/// the means of replications are independent and their spread is an honest standard error.
class Sampler {
 public:
  static constexpr std::uint32_t kReplication = 16;

  /// `independent` replaces the Sobol points by the stream.
  Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, bool independent = false);

  float next_1d();
  Vec2 next_2d();

  /// Stream for tracking, where the count of numbers is not known beforehand.
  Rng& rng() { return rng_; }

 private:
  static constexpr std::uint32_t kSobolDimensions = 48;

  std::uint64_t replication_hash_;
  std::uint32_t index_;      // within the replication
  std::uint32_t dimension_;  // the next one
  Rng rng_;
};

}  // namespace brume
