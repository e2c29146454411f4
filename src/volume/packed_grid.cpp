// SPDX-License-Identifier: Apache-2.0
#include "volume/packed_grid.h"

#include <nanovdb/util/GridBuilder.h>

namespace brume {

template <class PackedScalar>
std::shared_ptr<const Grid<PackedScalar>> packed(const Grid<float>& grid) {
  // Interpolation at the faces of the box touches one voxel more.
  const glm::ivec3 lo = glm::ivec3(glm::floor(grid.box().min)) - 1;
  const glm::ivec3 hi = glm::ivec3(glm::ceil(grid.box().max)) + 1;
  const auto& tree = grid.nano().tree();
  nanovdb::GridBuilder<float, typename detail::NanoType<PackedScalar>::type> builder(
      tree.background());
  builder.setStats(nanovdb::StatsMode::Disable);
  builder([&](const nanovdb::Coord& voxel) { return tree.getValue(voxel); },
          {nanovdb::Coord(lo.x, lo.y, lo.z), nanovdb::Coord(hi.x, hi.y, hi.z)});
  return std::make_shared<const Grid<PackedScalar>>(builder.template getHandle<>(),
                                                    grid.world_from_index(), grid.box(),
                                                    grid.interpolation(), Wrap::kBackground);
}

template std::shared_ptr<const Grid<Packed16>> packed(const Grid<float>&);
template std::shared_ptr<const Grid<Packed8>> packed(const Grid<float>&);

}  // namespace brume
