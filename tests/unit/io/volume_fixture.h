// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "core/error.h"
#include "io/volume_file.h"
#include "support/notices.h"
#include "support/temporary_folder.h"

namespace brume::test {

/// Writes small volume files and reads them back through the functions under test.
class VolumeTest : public ::testing::Test {
 protected:
  VolumeTest() { openvdb::initialize(); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::string write_vdb(const openvdb::GridPtrVec& grids,
                        std::uint32_t compression = openvdb::io::COMPRESS_ZIP |
                                                    openvdb::io::COMPRESS_ACTIVE_MASK) const {
    openvdb::io::File file(path("test.vdb"));
    file.setCompression(compression);
    file.write(grids);
    return path("test.vdb");
  }

  std::string write_bytes(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes).string();
  }

  static std::string read_bytes(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::shared_ptr<const Grid<float>> load(const std::string& file, const std::string& grid = {}) {
    notices_ = {};
    return load_scalar_grid({.path = file, .grid = grid}, notices_);
  }

  std::shared_ptr<const Grid<Rgb>> load_colour(const std::string& file,
                                               const std::string& grid = {}) {
    notices_ = {};
    return std::get<1>(load_grid({.path = file, .grid = grid}, notices_));
  }

  /// A grid with one voxel of value 2 at (1, 2, 3).
  template <class GridType = openvdb::FloatGrid>
  static typename GridType::Ptr one_voxel(const std::string& name = "density") {
    using Value = typename GridType::ValueType;
    auto grid = GridType::create(openvdb::zeroVal<Value>());
    grid->tree().setValue(openvdb::Coord(1, 2, 3), Value(2));
    grid->setName(name);
    return grid;
  }

  Notices notices_;

 private:
  TemporaryFolder folder_;
};

inline float voxel(const Grid<float>& grid, int x, int y, int z) {
  return GridLookup<float>(grid).nearest(Vec3(float(x), float(y), float(z)));
}

/// The message of the Error that `work` throws; empty when it throws none.
inline std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

}  // namespace brume::test
