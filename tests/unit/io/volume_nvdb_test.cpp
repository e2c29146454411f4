// SPDX-License-Identifier: Apache-2.0
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include "volume_fixture.h"

namespace brume {
namespace {

using nanovdb::io::Codec;
using test::error_of;
using test::voxel;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class NvdbFileLaw : public test::VolumeTest {
 protected:
  /// A ramp of 20^3 voxels of size 0.5, value x / 10.
  static openvdb::FloatGrid::Ptr ramp() {
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    for (int z = 0; z < 20; ++z)
      for (int y = 0; y < 20; ++y)
        for (int x = 1; x < 20; ++x) grid->tree().setValue({x, y, z}, float(x) / 10.0f);
    return grid;
  }

  std::string write_nvdb(const std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>>& handles,
                         Codec codec) const {
    nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(path("test.nvdb"), handles, codec);
    return path("test.nvdb");
  }

  std::string write_nvdb(nanovdb::GridHandle<nanovdb::HostBuffer> handle, Codec codec) const {
    std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
    handles.push_back(std::move(handle));
    return write_nvdb(handles, codec);
  }

  void expect_ramp(const Grid<float>& grid, float tolerance) {
    EXPECT_NEAR(voxel(grid, 7, 3, 19), 0.7f, tolerance);
    EXPECT_NEAR(voxel(grid, 19, 19, 0), 1.9f, tolerance);
    EXPECT_EQ(voxel(grid, 20, 0, 0), 0.0f);
    EXPECT_EQ(grid.world_from_index()[2][2], 0.5);
    EXPECT_EQ(grid.box().max, Vec3(20.0f));
  }
};

TEST_F(NvdbFileLaw, EveryCodecGivesTheSameVoxels) {
  for (const Codec codec : {Codec::NONE, Codec::ZIP, Codec::BLOSC})
    expect_ramp(*load(write_nvdb(nanovdb::openToNanoVDB(*ramp()), codec)), 0.0f);
}

TEST_F(NvdbFileLaw, QuantizedFloatsAreRead) {
  using Buffer = nanovdb::HostBuffer;
  using Tree = openvdb::FloatTree;
  expect_ramp(
      *load(write_nvdb(nanovdb::openToNanoVDB<Buffer, Tree, nanovdb::Fp4>(*ramp()), Codec::ZIP)),
      0.1f);
  expect_ramp(
      *load(write_nvdb(nanovdb::openToNanoVDB<Buffer, Tree, nanovdb::Fp8>(*ramp()), Codec::ZIP)),
      0.01f);
  expect_ramp(
      *load(write_nvdb(nanovdb::openToNanoVDB<Buffer, Tree, nanovdb::Fp16>(*ramp()), Codec::ZIP)),
      1e-4f);
  expect_ramp(
      *load(write_nvdb(nanovdb::openToNanoVDB<Buffer, Tree, nanovdb::FpN>(*ramp()), Codec::ZIP)),
      0.1f);
}

TEST_F(NvdbFileLaw, GridsAreChosenByName) {
  std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
  const auto flags = one_voxel<openvdb::Int32Grid>("flags");
  const auto color = one_voxel<openvdb::Vec3SGrid>("Cd");
  handles.push_back(nanovdb::openToNanoVDB(*flags));
  handles.push_back(nanovdb::openToNanoVDB(*color));
  handles.push_back(nanovdb::openToNanoVDB(*ramp()));
  const std::string file = write_nvdb(handles, Codec::BLOSC);
  expect_ramp(*load(file), 0.0f);
  expect_ramp(*load(file, "density"), 0.0f);
  EXPECT_EQ(GridLookup<Rgb>(*load_colour(file, "Cd")).nearest({1, 2, 3}), Rgb(2.0f));
  EXPECT_THAT(error_of([&] { load(file, "flags"); }),
              AllOf(HasSubstr("int32"), HasSubstr("Cd: vec3 float"), HasSubstr("density: float")));
  EXPECT_THAT(error_of([&] { load(file, "densty"); }), HasSubstr("did you mean \"density\"?"));
}

TEST_F(NvdbFileLaw, GridsWithoutNamesHaveNumbers) {
  const auto grid = ramp();
  grid->setName("");
  const std::string file = write_nvdb(nanovdb::openToNanoVDB(*grid), Codec::NONE);
  EXPECT_EQ(list_grids(file).at(0).selector, "[0]");
  expect_ramp(*load(file, "[0]"), 0.0f);
}

TEST_F(NvdbFileLaw, GridsThatShareABufferAreAllFound) {
  // The file lists the first of them only.
  const auto flags = one_voxel<openvdb::Int32Grid>("flags");
  const auto first = nanovdb::openToNanoVDB(*flags), second = nanovdb::openToNanoVDB(*ramp());
  for (const Codec codec : {Codec::NONE, Codec::ZIP, Codec::BLOSC}) {
    auto both = nanovdb::HostBuffer::create(first.size() + second.size());
    std::memcpy(both.data(), first.data(), first.size());
    std::memcpy(both.data() + first.size(), second.data(), second.size());
    std::uint32_t index = 0;
    for (const std::uint64_t at : {std::uint64_t(0), first.size()}) {
      auto& grid = *reinterpret_cast<nanovdb::GridData*>(both.data() + at);
      grid.mGridIndex = index++;
      grid.mGridCount = 2;
    }
    const std::string file =
        write_nvdb(nanovdb::GridHandle<nanovdb::HostBuffer>(std::move(both)), codec);
    const std::vector<GridSummary> grids = list_grids(file);
    ASSERT_EQ(grids.size(), 2u);
    EXPECT_EQ(describe(grids[1]),
              "density: float, no class, 7600 active voxels in [1, 0, 0] .. [19, 19, 19], voxel "
              "size 0.5");
    expect_ramp(*load(file), 0.0f);

    std::string bytes = read_bytes(file);
    if (codec != Codec::NONE) continue;
    const std::uint64_t far = std::uint64_t(1) << 40;
    const std::size_t size_at =
        bytes.size() - second.size() + offsetof(nanovdb::GridData, mGridSize);
    bytes.replace(size_at, sizeof far, reinterpret_cast<const char*>(&far), sizeof far);
    EXPECT_THAT(error_of([&] { load(write_bytes("far.nvdb", bytes)); }),
                HasSubstr("a grid lies outside the data"));
  }
}

TEST_F(NvdbFileLaw, OtherVersionsAreNamed) {
  std::string bytes = read_bytes(write_nvdb(nanovdb::openToNanoVDB(*ramp()), Codec::NONE));
  const nanovdb::Version old(28, 1, 2);
  bytes.replace(8, sizeof old, reinterpret_cast<const char*>(&old), sizeof old);
  EXPECT_THAT(error_of([&] { load(write_bytes("old.nvdb", bytes)); }),
              AllOf(HasSubstr("28.1.2"), HasSubstr("expected 32.x")));
}

}  // namespace
}  // namespace brume
