// SPDX-License-Identifier: Apache-2.0
#include "core/sampler.h"

#include <array>

#include "core/hash.h"

namespace brume {
namespace {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// Hash in which a bit depends only on the bits below it (Laine and Karras 2011; constants of
/// Burley 2020, listing 3 as improved by Vegdahl 2021).
constexpr std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Top 24 bits as a float in [0, 1).
constexpr float to_unit_interval(std::uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}

/// Position of a sample in its replication after Owen scrambling of their order.
constexpr std::uint32_t position(std::uint32_t reversed_index, std::uint32_t seed) {
  return reverse_bits(laine_karras(reversed_index, seed)) % Sampler::kReplication;
}

/// Second Sobol dimension of each position, the Pascal matrix modulo 2 applied to its bits, in
/// reversed bits.
constexpr auto kSobolSecond = [] {
  std::array<std::uint8_t, Sampler::kReplication> table{};
  for (std::uint32_t index = 0; index < table.size(); ++index) {
    std::uint32_t v = 1;
    for (std::uint32_t i = index; i != 0; i >>= 1, v ^= v << 1)
      if (i & 1u) table[index] ^= std::uint8_t(v);
  }
  return table;
}();

/// Owen scrambling of the digits after the binary point, which come with their bits reversed, as
/// a float in [0, 1).
constexpr float owen_scramble(std::uint32_t reversed, std::uint32_t seed) {
  return to_unit_interval(reverse_bits(laine_karras(reversed, seed)));
}

}  // namespace

Sampler::Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, bool independent)
    : block_seed_(hash_combine(seed, sample / kBlock)),
      index_in_block_(sample % kBlock),
      replication_hash_(hash_combine(hash_combine(seed, pixel), sample / kReplication)),
      reversed_index_(reverse_bits(sample % kReplication)),
      dimension_(independent ? kSobolDimensions : 0),
      rng_(hash_combine(replication_hash_, sample % kReplication), pixel) {}

Sampler Sampler::split(std::uint32_t part) const {
  Sampler own = *this;
  own.replication_hash_ = hash_combine(mix_bits(replication_hash_), part);
  own.rng_ = Rng(hash_combine(own.replication_hash_, reversed_index_), dimension_);
  return own;
}

float Sampler::next_1d() {
  if (dimension_ >= kSobolDimensions) return rng_.next_float();
  const std::uint64_t hash = hash_combine(replication_hash_, dimension_);
  dimension_ += 1;
  return owen_scramble(position(reversed_index_, static_cast<std::uint32_t>(hash)),
                       static_cast<std::uint32_t>(hash >> 32));
}

Vec2 Sampler::next_2d() {
  if (dimension_ >= kSobolDimensions) return rng_.next_vec2();
  const std::uint64_t hash = hash_combine(replication_hash_, dimension_);
  const std::uint64_t scrambles = mix_bits(hash);
  dimension_ += 2;
  // The first Sobol dimension is the position itself with its bits reversed.
  const std::uint32_t i = position(reversed_index_, static_cast<std::uint32_t>(hash));
  return {owen_scramble(i, static_cast<std::uint32_t>(scrambles)),
          owen_scramble(kSobolSecond[i], static_cast<std::uint32_t>(scrambles >> 32))};
}

}  // namespace brume
