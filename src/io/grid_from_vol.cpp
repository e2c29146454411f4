// SPDX-License-Identifier: Apache-2.0
#include "io/grid_from_vol.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cmath>

#include "io/grid_checks.h"

namespace brume {
namespace {

int wrapped_index(int i, int n, Wrap wrap) {
  if (wrap == Wrap::kRepeat) return (i + n) % n;
  return std::clamp(i, 0, n - 1);  // one layer of a mirror is a clamp too
}

/// Voxels with a NaN or infinity in a channel, counted while a tree is filled: OpenVDB takes a NaN
/// for the background then.
struct NonFiniteVoxels {
  std::uint64_t count = 0;
  std::size_t first = 0;

  /// `values` are those of the voxels from number `begin` on.
  void add(const std::vector<float>& values, std::size_t channels, std::size_t begin) {
    for (std::size_t i = 0; i < values.size(); i += channels) {
      const auto voxel = values.begin() + std::ptrdiff_t(i);
      if (std::all_of(voxel, voxel + std::ptrdiff_t(channels),
                      [](float v) { return std::isfinite(v); }))
        continue;
      if (count++ == 0) first = begin + i / channels;
    }
  }
};

}  // namespace

template <class OpenGrid>
void fill_from_vol(OpenGrid& grid, const VolHeader& vol, const NextLayers& next_layers,
                   const glm::dmat4& world_from_index, const std::string& label) {
  using OpenValue = typename OpenGrid::ValueType;
  const glm::ivec3 n = vol.resolution;
  const std::size_t layer = std::size_t(n.x) * std::size_t(n.y);
  // Whole leaves, and enough at a time that there are few rounds.
  constexpr std::size_t kVoxels = 1 << 20;
  const int layers =
      8 * int(std::clamp(kVoxels / (8 * layer), std::size_t(1), std::size_t(n.z) / 8 + 1));
  NonFiniteVoxels bad;
  for (int z = 0; z < n.z; z += layers) {
    const int end = std::min(z + layers, n.z);
    std::vector<float> values = next_layers(end - z);
    bad.add(values, std::size_t(vol.channels), std::size_t(z) * layer);
    const openvdb::tools::Dense<OpenValue, openvdb::tools::LayoutXYZ> dense(
        openvdb::CoordBBox(openvdb::Coord(0, 0, z), openvdb::Coord(n.x - 1, n.y - 1, end - 1)),
        reinterpret_cast<OpenValue*>(values.data()));
    openvdb::tools::copyFromDense(dense, grid, openvdb::zeroVal<OpenValue>());
  }
  if (bad.count == 0) return;
  const std::size_t x = bad.first % std::size_t(n.x),
                    y = bad.first / std::size_t(n.x) % std::size_t(n.y);
  fail_as_non_finite(bad.count, {int(x), int(y), int(bad.first / layer)}, world_from_index, label);
}

template <class OpenGrid>
void add_wrapped_layer(OpenGrid& grid, const glm::ivec3& n, Wrap wrap) {
  auto accessor = grid.getAccessor();
  for (int z = -1; z <= n.z; ++z)
    for (int y = -1; y <= n.y; ++y) {
      const bool outside = y < 0 || y == n.y || z < 0 || z == n.z;
      for (int x = -1; x <= n.x; x += outside ? 1 : n.x + 1) {
        const openvdb::Coord inside(wrapped_index(x, n.x, wrap), wrapped_index(y, n.y, wrap),
                                    wrapped_index(z, n.z, wrap));
        // By value: setting a voxel may do away with the tile that a reference leads to. Without
        // the background, the layer of an empty face takes no memory.
        const auto value = typename OpenGrid::ValueType(accessor.getValue(inside));
        if (value != grid.background()) accessor.setValue({x, y, z}, value);
      }
    }
}

template void fill_from_vol(openvdb::FloatGrid&, const VolHeader&, const NextLayers&,
                            const glm::dmat4&, const std::string&);
template void fill_from_vol(openvdb::Vec3SGrid&, const VolHeader&, const NextLayers&,
                            const glm::dmat4&, const std::string&);
template void add_wrapped_layer(openvdb::FloatGrid&, const glm::ivec3&, Wrap);
template void add_wrapped_layer(openvdb::Vec3SGrid&, const glm::ivec3&, Wrap);

}  // namespace brume
