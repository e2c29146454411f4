// SPDX-License-Identifier: Apache-2.0
#include <openvdb/io/Stream.h>
#include <openvdb/math/Maps.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "volume_fixture.h"

namespace brume {
namespace {

using test::error_of;
using test::voxel;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class VdbFileLaw : public test::VolumeTest {};

TEST_F(VdbFileLaw, FloatHalfAndDoubleGiveTheSameVoxels) {
  const auto half = one_voxel();
  half->setSaveFloatAsHalf(true);
  for (const openvdb::GridBase::Ptr& grid :
       {openvdb::GridBase::Ptr(one_voxel()), openvdb::GridBase::Ptr(half),
        openvdb::GridBase::Ptr(one_voxel<openvdb::DoubleGrid>())})
    for (const std::uint32_t compression :
         {openvdb::io::COMPRESS_NONE + 0, openvdb::io::COMPRESS_ZIP + 0,
          openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK}) {
      const auto loaded = load(write_vdb({grid}, compression));
      EXPECT_EQ(voxel(*loaded, 1, 2, 3), 2.0f);
      EXPECT_EQ(voxel(*loaded, 2, 2, 3), 0.0f);
      EXPECT_THAT(test::in_words(notices_), IsEmpty());
    }
}

TEST_F(VdbFileLaw, BoxIsTheReachOfInterpolation) {
  const std::string file = write_vdb({one_voxel()});
  const auto trilinear = load(file);
  EXPECT_EQ(trilinear->box().min, Vec3(0, 1, 2));
  EXPECT_EQ(trilinear->box().max, Vec3(2, 3, 4));
  const auto nearest =
      load_scalar_grid({.path = file, .interpolation = Interpolation::kNearest}, notices_);
  EXPECT_EQ(nearest->box().min, Vec3(0.5f, 1.5f, 2.5f));
  EXPECT_EQ(nearest->box().max, Vec3(1.5f, 2.5f, 3.5f));
}

TEST_F(VdbFileLaw, ActiveTilesAreRead) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->tree().addTile(/*level=*/1, openvdb::Coord(8, 16, -8), 0.25f, true);
  grid->setName("density");
  const auto loaded = load(write_vdb({grid}));
  EXPECT_EQ(loaded->box().min, Vec3(7, 15, -9));
  EXPECT_EQ(loaded->box().max, Vec3(16, 24, 0));
  EXPECT_EQ(voxel(*loaded, 15, 23, -1), 0.25f);
}

TEST_F(VdbFileLaw, AnyAffineMapIsKept) {
  const auto grid = one_voxel();
  // OpenVDB's matrices act on row vectors: rotated, mirrored, non-cubic, translated.
  const openvdb::Mat4d map(0.0, 0.5, 0.0, 0.0, -0.25, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0, 0.0, 10.0,
                           20.0, 30.0, 1.0);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(map));
  const std::string file = write_vdb({grid});
  const glm::dmat4 to_world = glm::scale(glm::dmat4(1), glm::dvec3(3.0));
  const auto loaded = load_scalar_grid({.path = file, .to_world = to_world}, notices_);
  for (const glm::ivec3& i : {glm::ivec3(0), glm::ivec3(1, 2, 3), glm::ivec3(-4, 5, 7)}) {
    const openvdb::Vec3d want = 3.0 * grid->indexToWorld(openvdb::Vec3d(i.x, i.y, i.z));
    const glm::dvec4 got = loaded->world_from_index() * glm::dvec4(i, 1.0);
    EXPECT_NEAR(got.x, want.x(), 1e-12);
    EXPECT_NEAR(got.y, want.y(), 1e-12);
    EXPECT_NEAR(got.z, want.z(), 1e-12);
  }
}

TEST_F(VdbFileLaw, FrustumIsRefused) {
  const auto grid = one_voxel();
  grid->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10.0));
  const std::string file = write_vdb({grid});
  EXPECT_THAT(error_of([&] { load(file); }),
              AllOf(HasSubstr(file), HasSubstr("NonlinearFrustumMap"), HasSubstr("not affine")));
}

TEST_F(VdbFileLaw, SingularPlacementIsRefused) {
  const std::string file = write_vdb({one_voxel()});
  for (const double flat : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const glm::dmat4 to_world = glm::scale(glm::dmat4(1), glm::dvec3(1.0, flat, 1.0));
    EXPECT_THAT(error_of([&] { load_scalar_grid({.path = file, .to_world = to_world}, notices_); }),
                HasSubstr("singular"));
  }
}

TEST_F(VdbFileLaw, GridsOfOneNameAreToldApartByIndex) {
  openvdb::GridPtrVec grids;
  for (int i = 0; i < 3; ++i) {
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->tree().setValue(openvdb::Coord(0, 0, 0), float(i + 1));
    grid->setName("density");
    grids.push_back(grid);
  }
  const std::string file = write_vdb(grids);
  EXPECT_EQ(voxel(*load(file, "density[2]"), 0, 0, 0), 3.0f);
  EXPECT_THAT(test::in_words(notices_), IsEmpty());
  for (const char* unclear : {"density", ""}) {
    EXPECT_EQ(voxel(*load(file, unclear), 0, 0, 0), 1.0f);
    EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("took \"density[0]\"")));
  }
}

TEST_F(VdbFileLaw, TheOnlyGridThatFitsIsFoundUnderAnyName) {
  const std::string file = write_vdb({one_voxel<openvdb::Vec3SGrid>("velocity"),
                                      one_voxel<openvdb::Int32Grid>("flags"), one_voxel("soot")});
  EXPECT_EQ(voxel(*load(file), 1, 2, 3), 2.0f);
  EXPECT_EQ(voxel(*load(file, "soot[0]"), 1, 2, 3), 2.0f);
  EXPECT_EQ(load_grid({.path = file}, notices_).index(), 0u);
  const auto colour = load_colour(file, "velocity");
  EXPECT_EQ(GridLookup<Rgb>(*colour).nearest({1, 2, 3}), Rgb(2.0f));
}

TEST_F(VdbFileLaw, WrongRequestsListWhatTheFileHolds) {
  const std::string file =
      write_vdb({one_voxel<openvdb::Vec3SGrid>("velocity"), one_voxel<openvdb::Int32Grid>("flags"),
                 one_voxel<openvdb::BoolGrid>("mask"), one_voxel("heat"), one_voxel("soot")});
  const auto lists_all =
      AllOf(HasSubstr(file), HasSubstr("velocity: vec3 float"), HasSubstr("flags: int32"),
            HasSubstr("mask: bool"), HasSubstr("heat: float"), HasSubstr("1 active voxels"));
  EXPECT_THAT(error_of([&] { load(file, "sot"); }),
              AllOf(lists_all, HasSubstr("did you mean \"soot\"?")));
  EXPECT_THAT(error_of([&] { load(file); }), AllOf(lists_all, HasSubstr("several grids")));
  EXPECT_THAT(error_of([&] { load(file, "soot[1]"); }), lists_all);
  for (const char* wrong : {"velocity", "flags", "mask"})
    EXPECT_THAT(error_of([&] { load(file, wrong); }), AllOf(lists_all, HasSubstr("not a density")));
  EXPECT_THAT(error_of([&] { load_colour(file, "flags"); }),
              AllOf(lists_all, HasSubstr("not a density or a colour")));
}

TEST_F(VdbFileLaw, PointsAreRefusedByName) {
  const auto points = openvdb::points::PointDataGrid::create();
  points->setName("points");
  EXPECT_THAT(error_of([&] { load(write_vdb({points})); }), HasSubstr("points: points"));
}

TEST_F(VdbFileLaw, UnknownTypesAreListedAndDoNotHideTheOthers) {
  const std::string file = write_vdb({one_voxel(), one_voxel<openvdb::Int32Grid>("flags")});
  std::string bytes = read_bytes(file);
  const std::string known = "Tree_int32_5_4_3";
  bytes.replace(bytes.find(known), known.size(), "Tree_quat8_5_4_3");
  const std::string changed = write_bytes("changed.vdb", bytes);
  EXPECT_EQ(voxel(*load(changed), 1, 2, 3), 2.0f);
  EXPECT_THAT(error_of([&] { load(changed, "flags"); }),
              HasSubstr("unknown type \"Tree_quat8_5_4_3\""));
}

TEST_F(VdbFileLaw, NonFiniteVoxelsAreCountedAndLocated) {
  const auto grid = one_voxel();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->tree().setValue(openvdb::Coord(5, 4, 9), std::nanf(""));
  grid->tree().setValue(openvdb::Coord(-7, 9, 8), std::numeric_limits<float>::infinity());
  grid->tree().setValueOff(openvdb::Coord(6, 4, 9), std::nanf(""));  // interpolation reads it too
  EXPECT_THAT(error_of([&] { load(write_vdb({grid})); }),
              AllOf(HasSubstr("grid \"density\""), HasSubstr("3 voxels are NaN, infinite"),
                    HasSubstr("voxel (-7, 9, 8), at (-3.5, 4.5, 4)")));
}

TEST_F(VdbFileLaw, DoublesKeepTilesBackgroundsAndStates) {
  const auto grid = openvdb::DoubleGrid::create(0.25);
  grid->tree().setValue(openvdb::Coord(1, 2, 3), 2.0);
  grid->tree().setValueOff(openvdb::Coord(4, 5, 6), 3.0);
  grid->tree().addTile(1, openvdb::Coord(0, 0, 64), 0.5, true);
  grid->tree().addTile(1, openvdb::Coord(0, 0, 72), 0.75, false);
  const auto loaded = load(write_vdb({grid}));
  EXPECT_EQ(voxel(*loaded, 1, 2, 3), 2.0f);
  EXPECT_EQ(voxel(*loaded, 4, 5, 6), 3.0f);
  EXPECT_EQ(voxel(*loaded, 1, 1, 1), 0.25f);
  EXPECT_EQ(voxel(*loaded, 7, 7, 71), 0.5f);
  EXPECT_EQ(voxel(*loaded, 0, 0, 72), 0.75f);
  EXPECT_EQ(voxel(*loaded, 0, 0, -500), 0.25f);
}

TEST_F(VdbFileLaw, DoublesTooLargeForFloatAreInfinite) {
  const auto grid = one_voxel<openvdb::DoubleGrid>();
  grid->tree().setValue(openvdb::Coord(0, 0, 0), 1e300);
  EXPECT_THAT(error_of([&] { load(write_vdb({grid})); }), HasSubstr("too large for float"));
}

TEST_F(VdbFileLaw, NegativeDensitiesBecomeZeroAndAreCounted) {
  const auto grid = one_voxel();
  grid->tree().setValue(openvdb::Coord(0, 0, 0), -1.0f);
  grid->tree().addTile(1, openvdb::Coord(64, 0, 0), -0.5f, true);
  const auto loaded = load(write_vdb({grid}));
  EXPECT_EQ(voxel(*loaded, 0, 0, 0), 0.0f);
  EXPECT_EQ(voxel(*loaded, 65, 1, 1), 0.0f);
  EXPECT_THAT(test::in_words(notices_),
              ElementsAre(HasSubstr("513 negative voxels were set to 0")));
}

TEST_F(VdbFileLaw, InactiveVoxelsAreRenderedLikeActiveOnes) {
  const auto grid = one_voxel();
  grid->tree().setValueOff(openvdb::Coord(4, 2, 3), 3.0f);
  const auto loaded = load(write_vdb({grid}, openvdb::io::COMPRESS_NONE));
  EXPECT_EQ(voxel(*loaded, 4, 2, 3), 3.0f);
  EXPECT_EQ(loaded->box().max.x, 5.0f);
}

TEST_F(VdbFileLaw, EmptyGridIsVacuum) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("density");
  const auto loaded = load(write_vdb({grid}));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("vacuum")));
  EXPECT_EQ(voxel(*loaded, 0, 0, 0), 0.0f);
  EXPECT_EQ(loaded->box().size(), Vec3(1.0f));
}

TEST_F(VdbFileLaw, ZeroVoxelsAreVacuum) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->tree().setValue(openvdb::Coord(0, 0, 0), 0.0f);
  load(write_vdb({grid}));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("every voxel is 0")));
}

TEST_F(VdbFileLaw, BackgroundIsCutAtTheVoxels) {
  const auto grid = openvdb::FloatGrid::create(5.0f);
  grid->tree().setValue(openvdb::Coord(1, 2, 3), 2.0f);
  grid->setName("density");
  const auto loaded = load(write_vdb({grid}));
  EXPECT_EQ(loaded->box().min, Vec3(0.5f, 1.5f, 2.5f));
  EXPECT_EQ(loaded->box().max, Vec3(1.5f, 2.5f, 3.5f));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("outside its voxels is not 0")));
}

TEST_F(VdbFileLaw, LevelSetBecomesFog) {
  const auto sphere =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(10.0f, openvdb::Vec3f(0), 1.0f);
  sphere->setName("surface");
  const auto loaded = load(write_vdb({sphere}));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("level set")));
  EXPECT_EQ(voxel(*loaded, 0, 0, 0), 1.0f);
  EXPECT_EQ(voxel(*loaded, 11, 0, 0), 0.0f);
  const float edge = voxel(*loaded, 9, 0, 0);
  EXPECT_GT(edge, 0.0f);
  EXPECT_LT(edge, 1.0f);
}

TEST_F(VdbFileLaw, LevelSetWithoutAWidthTakesItsLargestDistance) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  for (int x = -4; x <= 4; ++x) grid->tree().setValue(openvdb::Coord(x, 0, 0), 0.5f * float(x));
  const auto loaded = load(write_vdb({grid}));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(AllOf(HasSubstr("value outside is 0"),
                                                          HasSubstr("took the "
                                                                    "largest distance in it, 2")),
                                                    HasSubstr("into fog")));
  EXPECT_EQ(voxel(*loaded, -4, 0, 0), 1.0f);
  EXPECT_EQ(voxel(*loaded, -1, 0, 0), 0.25f);
  EXPECT_EQ(voxel(*loaded, 1, 0, 0), 0.0f);
  EXPECT_EQ(voxel(*loaded, 0, 1, 0), 0.0f);
}

TEST_F(VdbFileLaw, LevelSetWithoutAnInsideSaysSo) {
  const auto grid = openvdb::FloatGrid::create(3.0f);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->tree().setValue(openvdb::Coord(0, 0, 0), 0.5f);
  load(write_vdb({grid}));
  EXPECT_THAT(test::in_words(notices_),
              ElementsAre(HasSubstr("without an inside"), HasSubstr("into fog"),
                          HasSubstr("empty, rendered as vacuum")));
}

TEST_F(VdbFileLaw, ColorsAreReadFromVectors) {
  const auto grid = openvdb::Vec3DGrid::create(openvdb::Vec3d(0.0));
  grid->tree().setValue(openvdb::Coord(0, 0, 0), openvdb::Vec3d(0.25, -1.0, 0.75));
  grid->setName("Cd");
  const auto loaded = load_colour(write_vdb({grid}));
  EXPECT_EQ(GridLookup<Rgb>(*loaded).nearest({0, 0, 0}), Rgb(0.25f, 0.0f, 0.75f));
  EXPECT_THAT(test::in_words(notices_), ElementsAre(HasSubstr("1 negative voxel was set to 0")));
}

TEST_F(VdbFileLaw, InstancesShareVoxelsUnderTheirOwnTransform) {
  const auto first = one_voxel("first");
  const auto second = openvdb::FloatGrid::create(first->treePtr());
  second->setName("second");
  second->setTransform(openvdb::math::Transform::createLinearTransform(0.125));
  const auto loaded = load(write_vdb({first, second}), "second");
  EXPECT_EQ(voxel(*loaded, 1, 2, 3), 2.0f);
  EXPECT_EQ(loaded->world_from_index()[0][0], 0.125);
}

TEST_F(VdbFileLaw, StreamsWithoutPositionsAreRead) {
  {
    std::ofstream stream(path("stream.vdb"), std::ios::binary);
    openvdb::io::Stream(stream).write(
        openvdb::GridCPtrVec{one_voxel<openvdb::Int32Grid>("flags"), one_voxel()});
  }
  EXPECT_EQ(list_grids(path("stream.vdb")).size(), 2u);
  EXPECT_EQ(voxel(*load(path("stream.vdb")), 1, 2, 3), 2.0f);
}

TEST_F(VdbFileLaw, SummaryTellsWhatIsInTheFile) {
  const auto grid = one_voxel();
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setSaveFloatAsHalf(true);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  const auto grids = list_grids(write_vdb({grid}));
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_EQ(describe(grids[0]),
            "density: half float, fog volume, 1 active voxels in [1, 2, 3] .. [1, 2, 3], "
            "voxel size 0.5");
  ASSERT_TRUE(grids[0].extent);
  EXPECT_GT(grids[0].extent->memory_bytes, 0u);
}

TEST_F(VdbFileLaw, FileWithoutGridsSaysSo) {
  EXPECT_THAT(error_of([&] { load(write_vdb({})); }), HasSubstr("The file holds no grids"));
}

TEST_F(VdbFileLaw, DistantVoxelsAreRefused) {
  const auto grid = one_voxel();
  grid->tree().setValue(openvdb::Coord(1 << 24, 0, 0), 1.0f);
  EXPECT_THAT(error_of([&] { load(write_vdb({grid})); }), HasSubstr("too far out"));
}

TEST_F(VdbFileLaw, WhatIsNoVolumeIsNamed) {
  EXPECT_THAT(error_of([&] { load(path("missing.vdb")); }), HasSubstr("missing.vdb"));
  EXPECT_THAT(error_of([&] { load(path("")); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { load("/dev/null"); }), HasSubstr("is a device or a pipe"));
  EXPECT_THAT(error_of([&] { load(write_bytes("empty.vdb", "")); }), HasSubstr("is empty"));
  EXPECT_THAT(error_of([&] { load(write_bytes("text.vdb", "hello, this is no volume")); }),
              HasSubstr("neither a .vdb"));
}

}  // namespace
}  // namespace brume
