// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "volume_fixture.h"

namespace brume {
namespace {

using test::error_of;
using test::voxel;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class VolFileLaw : public test::VolumeTest {
 protected:
  template <class T>
  std::string write_vol(const glm::ivec3& n, int channels, const std::vector<T>& values,
                        std::int32_t encoding = 1) const {
    std::string bytes("VOL\3", 4);
    const auto append = [&](const auto& value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(encoding);
    for (int axis = 0; axis < 3; ++axis) append(std::int32_t(n[axis]));
    append(std::int32_t(channels));
    for (const float x : {-1.0f, -2.0f, -3.0f, 1.0f, 2.0f, 5.0f}) append(x);
    for (const T& value : values) append(value);
    return write_bytes("test.vol", bytes);
  }

  /// 2 x 3 x 4 voxels numbered from 1, x fastest.
  std::string write_numbered() const {
    std::vector<float> values(24);
    for (int i = 0; i < 24; ++i) values[std::size_t(i)] = float(i + 1);
    return write_vol({2, 3, 4}, 1, values);
  }

  static glm::dvec3 world(const Grid<float>& grid, const glm::dvec3& index) {
    return glm::dvec3(grid.world_from_index() * glm::dvec4(index, 1.0));
  }
};

TEST_F(VolFileLaw, VoxelsAreStoredXFastest) {
  const auto grid = load(write_numbered());
  for (int i = 0; i < 24; ++i) EXPECT_EQ(voxel(*grid, i % 2, i / 2 % 3, i / 6), float(i + 1));
  EXPECT_EQ(grid->box().min, Vec3(-0.5f));
  EXPECT_EQ(grid->box().max, Vec3(1.5f, 2.5f, 3.5f));
}

TEST_F(VolFileLaw, DataFillsTheUnitCubeOrItsOwnBox) {
  const std::string file = write_numbered();
  const auto unit = load(file);
  EXPECT_EQ(world(*unit, glm::dvec3(-0.5)), glm::dvec3(0.0));
  EXPECT_LT(glm::length(world(*unit, {1.5, 2.5, 3.5}) - glm::dvec3(1.0)), 1e-15);
  const glm::dmat4 to_world = glm::scale(glm::dmat4(1), glm::dvec3(2.0));
  const auto own =
      load_scalar_grid({.path = file, .use_grid_bbox = true, .to_world = to_world}, notices_);
  EXPECT_LT(glm::length(world(*own, glm::dvec3(-0.5)) - glm::dvec3(-2, -4, -6)), 1e-14);
  EXPECT_LT(glm::length(world(*own, {1.5, 2.5, 3.5}) - glm::dvec3(2, 4, 10)), 1e-14);
}

TEST_F(VolFileLaw, OneLayerOutsideFollowsTheWrapMode) {
  const std::string file = write_numbered();
  const auto at_corner = [&](Wrap wrap) {
    const auto grid = load_scalar_grid({.path = file, .wrap = wrap}, notices_);
    return std::pair(voxel(*grid, -1, -1, -1), voxel(*grid, 2, 1, 1));
  };
  EXPECT_EQ(at_corner(Wrap::kClamp), std::pair(1.0f, 10.0f));
  EXPECT_EQ(at_corner(Wrap::kMirror), std::pair(1.0f, 10.0f));
  EXPECT_EQ(at_corner(Wrap::kRepeat), std::pair(24.0f, 9.0f));
  EXPECT_EQ(at_corner(Wrap::kBackground), std::pair(0.0f, 0.0f));
}

TEST_F(VolFileLaw, OneLayerOutsideEmptyVoxelsIsEmpty) {
  std::vector<float> values(64, 0.0f);
  values[63] = 1.0f;
  const auto grid = load(write_vol({64, 1, 1}, 1, values));
  for (int x = -1; x < 63; ++x)
    for (const glm::ivec2 beside : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 1)})
      EXPECT_EQ(voxel(*grid, x, beside.x, beside.y), 0.0f) << x;
}

TEST_F(VolFileLaw, ThreeChannelsAreAColor) {
  const std::string file = write_vol({2, 1, 1}, 3, std::vector<float>{1, 2, 3, 4, 5, 6});
  const auto grid = load_colour(file);
  EXPECT_EQ(GridLookup<Rgb>(*grid).nearest({1, 0, 0}), Rgb(4, 5, 6));
  EXPECT_THAT(error_of([&] { load(file); }), HasSubstr("a colour (3 channels a voxel)"));
}

TEST_F(VolFileLaw, VoxelsStayInPlaceInFilesThatAreReadInPieces) {
  const glm::ivec3 n(1023, 5, 1031);
  std::vector<float> values(std::size_t(n.x) * n.y * n.z);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i % 4093);
  const std::string file = write_vol(n, 1, values);
  const auto grid = load(file);
  GridLookup<float> lookup(*grid);
  for (std::size_t i = 0; i < values.size(); i += 101)
    ASSERT_EQ(lookup.nearest(Vec3(i % n.x, i / n.x % n.y, i / n.x / n.y)), values[i]) << i;
  values[(1030u * 5 + 4) * 1023 + 1022] = std::nanf("");
  EXPECT_THAT(error_of([&] { load(write_vol(n, 1, values)); }), HasSubstr("voxel (1022, 4, 1030)"));
}

TEST_F(VolFileLaw, WhatFollowsTheVoxelsIsMentioned) {
  load(write_bytes("long.vol", read_bytes(write_numbered()) + "more"));
  EXPECT_THAT(test::in_words(notices_),
              ElementsAre(HasSubstr("has 148 bytes, of which its header makes 144")));
}

TEST_F(VolFileLaw, HalfFloatsAndBytesAreRead) {
  const std::uint16_t half_of_1_5 = 0x3e00, zero = 0;
  const auto half = load(write_vol({3, 1, 1}, 1, std::vector{half_of_1_5, zero, half_of_1_5}, 2));
  EXPECT_EQ(voxel(*half, 0, 0, 0), 1.5f);
  EXPECT_EQ(voxel(*half, 1, 0, 0), 0.0f);
  EXPECT_EQ(voxel(*half, 2, 0, 0), 1.5f);
  const auto byte = load(write_vol({3, 1, 1}, 1, std::vector<std::uint8_t>{51, 0, 255}, 3));
  EXPECT_EQ(voxel(*byte, 0, 0, 0), 0.2f);
  EXPECT_EQ(voxel(*byte, 1, 0, 0), 0.0f);
  EXPECT_EQ(voxel(*byte, 2, 0, 0), 1.0f);
}

TEST_F(VolFileLaw, NegativeVoxelsAreCountedOnce) {
  const auto grid = load(write_vol({1, 1, 2}, 1, std::vector{-1.0f, 2.0f}));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("1 negative voxel was set to 0")));
  EXPECT_EQ(voxel(*grid, 0, 0, -1), 0.0f);
}

TEST_F(VolFileLaw, NaNIsLocated) {
  const std::string file = write_vol({2, 1, 1}, 1, std::vector{1.0f, std::nanf("")});
  EXPECT_THAT(
      error_of([&] { load(file); }),
      AllOf(HasSubstr("1 voxel is NaN"), HasSubstr("voxel (1, 0, 0), at (0.75, 0.5, 0.5)")));
}

TEST_F(VolFileLaw, ZeroVoxelsAreVacuum) {
  load(write_vol({2, 1, 1}, 1, std::vector{0.0f, 0.0f}));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("vacuum")));
}

TEST_F(VolFileLaw, BadHeadersSayWhatIsWrong) {
  const std::vector<float> one{1.0f};
  EXPECT_THAT(error_of([&] {
                load(write_vol({1, 1, 2}, 1, one));
              }),
              AllOf(HasSubstr("take 56 bytes"), HasSubstr("the file has 52")));
  EXPECT_THAT(error_of([&] {
                load(write_vol({1 << 30, 1 << 30, 1 << 30}, 3, one));
              }),
              HasSubstr("truncated"));
  EXPECT_THAT(error_of([&] { load(write_vol({1, -1, 1}, 1, one)); }), HasSubstr("1 x -1 x 1"));
  EXPECT_THAT(error_of([&] { load(write_vol({1, 1, 1}, 2, one)); }), HasSubstr("2 channels"));
  EXPECT_THAT(error_of([&] { load(write_vol({1, 1, 1}, 1, one, 7)); }), HasSubstr("encoding 7"));
  EXPECT_THAT(error_of([&] {
                load(write_bytes("old.vol", std::string("VOL\2", 4) + std::string(60, '\0')));
              }),
              HasSubstr("version 2"));
  EXPECT_THAT(error_of([&] { load(write_bytes("short.vol", std::string("VOL\3abcdef", 10))); }),
              HasSubstr("48 bytes, the file 10"));
}

TEST_F(VolFileLaw, FlatBoxIsRefused) {
  std::string bytes = read_bytes(write_numbered());
  std::memcpy(&bytes[36], &bytes[24], 4);  // max x = min x
  const std::string file = write_bytes("flat.vol", bytes);
  EXPECT_THAT(error_of([&] { load_scalar_grid({.path = file, .use_grid_bbox = true}, notices_); }),
              HasSubstr("singular"));
}

}  // namespace
}  // namespace brume
