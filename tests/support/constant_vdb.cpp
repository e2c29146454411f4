// SPDX-License-Identifier: Apache-2.0
#include "support/constant_vdb.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

namespace brume::test {

void write_constant_vdb(const std::filesystem::path& path, int n, double value) {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(n - 1)), float(value));
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0 / n);
  transform->postTranslate(openvdb::Vec3d(0.5 / n));
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setName("density");
  openvdb::io::File(path.string()).write(openvdb::GridPtrVec{grid});
}

}  // namespace brume::test
