// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "volume/grid.h"

namespace brume {

/// A scalar of a grid that keeps it in fewer bits. Codes count in equal steps from the smallest to
/// the largest value of a block of 8^3 voxels, so that none is off by more than half a step.
template <int kBits>
struct Packed {
  Packed(float v) : value(v) {}  // NOLINT: reads like the scalar that it is
  operator float() const { return value; }
  float value;
};
using Packed16 = Packed<16>;
using Packed8 = Packed<8>;

namespace detail {
template <>
struct NanoType<Packed16> {
  using type = nanovdb::Fp16;
};
template <>
struct NanoType<Packed8> {
  using type = nanovdb::Fp8;
};

/// What a lookup in a grid of `Stored` counts as.
template <class Stored>
struct Looked {
  using type = Stored;
};
template <int kBits>
struct Looked<Packed<kBits>> {
  using type = float;
};
}  // namespace detail

/// `grid` with its scalars packed, for lookups inside its box; elsewhere it has its background.
template <class PackedScalar>
std::shared_ptr<const Grid<PackedScalar>> packed(const Grid<float>& grid);

}  // namespace brume
