// SPDX-License-Identifier: Apache-2.0
#include "core/sampler.h"

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

/// Owen scrambling of the digits after the binary point.
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(laine_karras(reverse_bits(x), seed));
}

/// Position of sample `i` after Owen scrambling of the order within its replication.
constexpr std::uint32_t shuffle(std::uint32_t i, std::uint32_t seed) {
  return owen_scramble(i, seed) % Sampler::kReplication;
}

/// Second Sobol dimension: the Pascal matrix modulo 2 applied to the bits of `i`.
constexpr std::uint32_t sobol_second(std::uint32_t i) {
  std::uint32_t result = 0;
  for (std::uint32_t v = 1u << 31; i != 0; i >>= 1, v ^= v >> 1)
    if (i & 1u) result ^= v;
  return result;
}

/// Top 24 bits as a float in [0, 1).
constexpr float to_unit_interval(std::uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}

}  // namespace

Sampler::Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, bool independent)
    : replication_hash_(hash_combine(hash_combine(seed, pixel), sample / kReplication)),
      index_(sample % kReplication),
      dimension_(independent ? kSobolDimensions : 0),
      rng_(hash_combine(replication_hash_, index_), pixel) {}

float Sampler::next_1d() {
  if (dimension_ >= kSobolDimensions) return rng_.next_float();
  const std::uint64_t hash = hash_combine(replication_hash_, dimension_);
  dimension_ += 1;
  const std::uint32_t index = shuffle(index_, static_cast<std::uint32_t>(hash));
  return to_unit_interval(
      owen_scramble(reverse_bits(index), static_cast<std::uint32_t>(hash >> 32)));
}

Vec2 Sampler::next_2d() {
  if (dimension_ >= kSobolDimensions) return rng_.next_vec2();
  const std::uint64_t hash = hash_combine(replication_hash_, dimension_);
  const std::uint64_t scrambles = mix_bits(hash);
  dimension_ += 2;
  const std::uint32_t index = shuffle(index_, static_cast<std::uint32_t>(hash));
  return {
      to_unit_interval(owen_scramble(reverse_bits(index), static_cast<std::uint32_t>(scrambles))),
      to_unit_interval(
          owen_scramble(sobol_second(index), static_cast<std::uint32_t>(scrambles >> 32)))};
}

}  // namespace brume
