// SPDX-License-Identifier: Apache-2.0
#include "statistics/constant_nvdb.h"

#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

namespace brume::test {

void write_constant_nvdb(const std::filesystem::path& path, int n, double value) {
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  builder([&](const nanovdb::Coord& /*voxel*/) { return float(value); },
          nanovdb::CoordBBox(nanovdb::Coord(0), nanovdb::Coord(n - 1)));
  const auto handle = builder.getHandle<>(1.0 / n, nanovdb::Vec3d(0.5 / n), "density");
  nanovdb::io::writeGrid(path.string(), handle);
}

}  // namespace brume::test
