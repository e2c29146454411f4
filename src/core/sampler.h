// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/rng.h"
#include "core/vec.h"

namespace brume {

/// Random numbers of one camera sample: a pure function of (seed, pixel, sample index, dimension).
///
/// The first dimensions are Owen-scrambled Sobol points, each pair scrambled and shuffled on its
/// own (Burley 2020); the rest, and `rng()`, are a PCG stream of the sample. Samples come in
/// replications of `kReplication` consecutive indices that are scrambled independently, so that
/// the means of replications are independent and their spread is an honest standard error. Each
/// block of `kBlock` consecutive indices is stratified in itself.
class Sampler {
 public:
  static constexpr std::uint32_t kBlock = 16;
  static constexpr std::uint32_t kReplication = 64;

  /// `independent` replaces the Sobol points by the stream.
  Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, bool independent = false);

  /// Of path number `part` of those into which the sample's path splits here: independent of this
  /// one and of the other parts, and stratified with the same part of other samples.
  Sampler split(std::uint32_t part) const;

  float next_1d();
  Vec2 next_2d();
  /// Leaves a next_2d() to paths to which something else happened here.
  void skip_2d() { dimension_ += 2; }

  /// Goes on with the dimensions of flight number `flight` of the path, from 0. Paths that met
  /// different things before use them for the same purpose, and so stratify each other.
  void begin_flight(std::uint32_t flight) {
    // Never back: a number that was used is not used again.
    if (flight < kSobolFlights)
      dimension_ = std::max(dimension_, kCameraDimensions + kFlightDimensions * flight);
    else
      dimension_ = kSobolDimensions;
  }

  /// A seed that the samples of a block share with those of the same block in all other pixels, and
  /// the place of this sample among them.
  std::uint64_t block_seed() const { return block_seed_; }
  std::uint32_t index_in_block() const { return index_in_block_; }

  /// Stream for tracking, where the count of numbers is not known beforehand.
  Rng& rng() { return rng_; }

 private:
  static constexpr std::uint32_t kCameraDimensions = 4;   // film and lens
  static constexpr std::uint32_t kFlightDimensions = 15;  // the most that an event takes
  static constexpr std::uint32_t kSobolFlights = 4;
  static constexpr std::uint32_t kSobolDimensions =
      kCameraDimensions + kSobolFlights * kFlightDimensions;

  std::uint64_t block_seed_;
  std::uint32_t index_in_block_;
  std::uint64_t replication_hash_;
  std::uint32_t reversed_index_;  // within the replication, bit by bit
  std::uint32_t dimension_;       // the next one
  Rng rng_;
};

}  // namespace brume
