// SPDX-License-Identifier: Apache-2.0
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <cmath>

#include "core/rng.h"
#include "volume_fixture.h"

namespace brume {
namespace {

/// Whatever is done to a file, reading it ends in a grid or in an Error that names the file.
class DamagedFileLaw : public test::VolumeTest {
 protected:
  static openvdb::FloatGrid::Ptr ball() {
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    for (int z = -9; z <= 9; ++z)
      for (int y = -9; y <= 9; ++y)
        for (int x = -9; x <= 9; ++x)
          if (x * x + y * y + z * z < 81) grid->tree().setValue({x, y, z}, 0.01f * float(x + 20));
    grid->tree().addTile(2, openvdb::Coord(0, 128, 0), 0.5f, true);
    return grid;
  }

  void read_all(const std::string& file) {
    try {
      notices_ = {};
      load_grid({.path = file}, notices_);
      ++read_;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(file));
      ++refused_;
    }
  }

  /// Every short prefix, and longer ones here and there.
  void truncate(const std::string& bytes) {
    for (std::size_t size = 1; size < bytes.size(); size += 1 + size / 8) {
      const std::string file = write_bytes("short", bytes.substr(0, size));
      EXPECT_NE(test::error_of([&] { load(file); }), "") << size << " of " << bytes.size();
    }
  }

  /// Random bytes changed, most of them in the headers, where lengths and positions are.
  void scramble(const std::string& bytes, int rounds) {
    Rng rng(5);
    for (int round = 0; round < rounds; ++round) {
      std::string damaged = bytes;
      const std::size_t reach =
          round % 3 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 1500);
      for (int i = 0; i <= round % 4; ++i)
        damaged[std::size_t(rng.next_float() * float(reach))] = char(rng.next_float() * 256.0f);
      read_all(write_bytes("damaged", damaged));
    }
    EXPECT_GT(refused_, 0);
    EXPECT_GT(read_, 0);
  }

  int read_ = 0, refused_ = 0;
};

TEST_F(DamagedFileLaw, VdbEndsInAnError) {
  for (const std::uint32_t compression :
       {openvdb::io::COMPRESS_ACTIVE_MASK + 0,
        openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK,
        openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK}) {
    const std::string bytes = read_bytes(write_vdb({ball(), one_voxel("heat")}, compression));
    truncate(bytes);
    scramble(bytes, 150);
  }
}

TEST_F(DamagedFileLaw, VdbBlocksCannotOverrunTheirNodes) {
  // Values that do not compress are stored as they are, their size in bytes negated before them.
  Rng rng(3);
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("density");
  for (auto ijk = openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(7)).begin(); ijk; ++ijk)
    grid->tree().setValue(*ijk, std::exp2(80.0f * rng.next_float()));
  std::string bytes = read_bytes(write_vdb({grid}));
  const std::int64_t stored = -512 * 4, claimed = -65536;
  const auto place = bytes.find(std::string(reinterpret_cast<const char*>(&stored), 8));
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, 8, reinterpret_cast<const char*>(&claimed), 8);
  bytes.append(65536, '\0');
  EXPECT_THAT(test::error_of([&] { load(write_bytes("claims.vdb", bytes)); }),
              ::testing::HasSubstr("damaged values"));
}

TEST_F(DamagedFileLaw, NvdbEndsInAnError) {
  for (const auto codec :
       {nanovdb::io::Codec::NONE, nanovdb::io::Codec::ZIP, nanovdb::io::Codec::BLOSC}) {
    nanovdb::io::writeGrid(path("test.nvdb"), nanovdb::openToNanoVDB(*ball()), codec);
    const std::string bytes = read_bytes(path("test.nvdb"));
    truncate(bytes);
    scramble(bytes, 60);
  }
}

TEST_F(DamagedFileLaw, NvdbTreesThatPointElsewhereAreRefused) {
  nanovdb::io::writeGrid(path("test.nvdb"), nanovdb::openToNanoVDB(*ball()),
                         nanovdb::io::Codec::NONE);
  const std::string bytes = read_bytes(path("test.nvdb"));
  const std::size_t grid = bytes.size() - list_grids(path("test.nvdb")).at(0).extent->memory_bytes;
  // The tree's offsets, the root and its table lie right behind the grid's own 672 bytes.
  Rng rng(11);
  for (int round = 0; round < 200; ++round) {
    std::string damaged = bytes;
    damaged[grid + 672 + std::size_t(rng.next_float() * 256.0f)] = char(rng.next_float() * 256.0f);
    read_all(write_bytes("damaged.nvdb", damaged));
  }
  EXPECT_GT(refused_, 0);
}

TEST_F(DamagedFileLaw, NvdbNodesHaveOneParent) {
  auto handle = nanovdb::openToNanoVDB(*ball());
  auto* nodes = handle.grid<float>()->tree().getFirstNode<1>();
  const auto* leaf = nodes[0].data()->getChild(*nodes[0].childMask().beginOn());
  nodes[1].data()->setChild(*nodes[1].childMask().beginOn(), leaf);
  nanovdb::io::writeGrid(path("test.nvdb"), handle);
  EXPECT_THAT(test::error_of([&] { load(path("test.nvdb")); }),
              ::testing::HasSubstr("two nodes share a child"));
}

TEST_F(DamagedFileLaw, NvdbNodesThatGoMissingAreNoticed) {
  auto handle = nanovdb::openToNanoVDB(*ball());
  auto& node = *handle.grid<float>()->tree().getFirstNode<1>();
  node.data()->mChildMask.setOff(*node.childMask().beginOn());
  nanovdb::io::writeGrid(path("test.nvdb"), handle);
  EXPECT_THAT(test::error_of([&] { load(path("test.nvdb")); }),
              ::testing::HasSubstr("nodes of level 0 where it counts"));
}

TEST_F(DamagedFileLaw, VolEndsInAnError) {
  std::string bytes("VOL\3", 4);
  const std::int32_t header[] = {1, 4, 4, 4, 1, 0, 0, 0, 0x3f800000, 0x3f800000, 0x3f800000};
  bytes.append(reinterpret_cast<const char*>(header), sizeof header);
  for (int i = 0; i < 64; ++i) bytes.append("\0\0\x80\x3f", 4);
  truncate(bytes);
  scramble(bytes, 300);
}

}  // namespace
}  // namespace brume
