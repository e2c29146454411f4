// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "volume_fixture.h"

namespace brume {
namespace {

using test::error_of;
using test::voxel;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Real files from other programs, with the figures that other tools give for them. They are not
/// part of the project; without them these tests are skipped.
class SampleFileLaw : public test::VolumeTest {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(BRUME_SAMPLES))
      GTEST_SKIP() << "no sample files at " << BRUME_SAMPLES;
  }
  static std::string sample(const std::string& name) { return BRUME_SAMPLES "/" + name; }

  static glm::dvec3 voxel_edges(const Grid<float>& grid) {
    const glm::dmat4& m = grid.world_from_index();
    return {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
  }
};

struct SampleGrid {
  const char* file;
  const char* grid;
  std::uint64_t active_voxels;
  glm::ivec3 min, max;  // [voxels]
  double max_value;
};

class SampleGridLaw : public SampleFileLaw, public ::testing::WithParamInterface<SampleGrid> {};

TEST_P(SampleGridLaw, AgreesWithOtherTools) {
  const SampleGrid& want = GetParam();
  const auto grid = load(sample(want.file), want.grid);
  EXPECT_THAT(test::in_words(notices_), IsEmpty());
  EXPECT_EQ(grid->nano().activeVoxelCount(), want.active_voxels);
  EXPECT_EQ(grid->box().min, Vec3(want.min) - 1.0f);
  EXPECT_EQ(grid->box().max, Vec3(want.max) + 1.0f);
  float highest = 0.0f;
  for (int z = want.min.z; z <= want.max.z; ++z)
    for (int y = want.min.y; y <= want.max.y; ++y)
      for (int x = want.min.x; x <= want.max.x; ++x)
        highest = std::max(highest, voxel(*grid, x, y, z));
  EXPECT_NEAR(highest, want.max_value, 1e-5 * want.max_value);
}

INSTANTIATE_TEST_SUITE_P(
    Files, SampleGridLaw,
    ::testing::Values(
        SampleGrid{"vdb/wdas_cloud_sixteenth.vdb", "", 415642, {-66, -21, -90}, {59, 64, 63}, 1.0},
        SampleGrid{"vdb/openvdb_smoke_v222.vdb", "", 1049275, {1, 2, 1}, {111, 223, 112}, 5.71484},
        SampleGrid{"vdb/gaffer_sphere_fog.vdb", "", 465, {-5, -4, -5}, {5, 4, 5}, 1.0},
        SampleGrid{"vdb/usd_densityAndHeat.vdb", "", 6124, {1, 1, 31}, {23, 23, 72}, 0.997509},
        SampleGrid{"vdb/usd_densityAndHeat.vdb", "heat", 5224, {2, 2, 31}, {23, 22, 62}, 0.759538},
        SampleGrid{"vdb/usd_smoke_000003.vdb", "", 90197, {1, 1, 3}, {51, 49, 98}, 0.999985},
        SampleGrid{"vdb/arnold_three_density_grids.vdb",
                   "density[1]",
                   2222,
                   {-9, -13, -9},
                   {9, 5, 12},
                   10.0},
        SampleGrid{"vdb/arnold_torus01.vdb", "", 2450, {-25, -4, 1}, {-4, 4, 22}, 100.0},
        SampleGrid{"vdb/vpt_dragon_with_xform.vdb", "", 156161, {-70, 1, -31}, {70, 99, 31}, 1.0},
        SampleGrid{
            "nvdb/openvdb_smoke_blosc.nvdb", "", 1049275, {1, 2, 1}, {111, 223, 112}, 5.71484}));

TEST_F(SampleFileLaw, GridsOfOneNameKeepTheirTransforms) {
  const std::string file = sample("vdb/arnold_three_density_grids.vdb");
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(load(file, "density[" + std::to_string(i) + "]")->world_from_index()[3].x,
                4.0 - 2.0 * i, 1e-6);
  load(file);
  EXPECT_THAT(test::in_words(notices_), ::testing::ElementsAre(HasSubstr("took \"density[0]\"")));
}

TEST_F(SampleFileLaw, TransformsAreKept) {
  const glm::dvec3 dragon = voxel_edges(*load(sample("vdb/vpt_dragon_with_xform.vdb")));
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(dragon[axis], 0.12, 1e-4);
  EXPECT_GT(std::abs(load(sample("vdb/vpt_dragon_with_xform.vdb"))->world_from_index()[0].y), 0.01);
  const glm::dvec3 heat = voxel_edges(*load(sample("vdb/usd_densityAndHeat.vdb")));
  EXPECT_NEAR(heat.x, 0.703, 5e-4);
  EXPECT_NEAR(heat.z, 0.716, 5e-4);
  EXPECT_NEAR(voxel_edges(*load(sample("vdb/openvdb_smoke_v222.vdb"))).x, 0.476, 5e-4);
}

TEST_F(SampleFileLaw, LevelSetsBecomeFog) {
  const auto sphere = load(sample("vdb/openvdb_sphere_levelset.vdb"));
  EXPECT_THAT(test::in_words(notices_), ::testing::ElementsAre(HasSubstr("level set")));
  EXPECT_EQ(voxel(*sphere, 0, 0, 0), 1.0f);
  const auto batch = load(sample("nvdb/openvdb_batch.nvdb"));
  EXPECT_THAT(test::in_words(notices_), ::testing::Contains(HasSubstr("took \"z[0]\"")));
  EXPECT_THAT(test::in_words(notices_), ::testing::Contains(HasSubstr("value outside is 0")));
  EXPECT_EQ(batch->box().min, Vec3(-7, -11, -7));
}

TEST_F(SampleFileLaw, ABatchOfGridsIsListedWhole) {
  const std::string file = sample("nvdb/openvdb_batch.nvdb");
  std::vector<std::string> selectors;
  for (const GridSummary& grid : list_grids(file)) selectors.push_back(grid.selector);
  EXPECT_THAT(selectors, ::testing::ElementsAre("z[0]", "z[1]", "z[2]", "z[3]"));
  for (const std::string& selector : selectors) EXPECT_FALSE(load(file, selector)->box().empty());
}

TEST_F(SampleFileLaw, BrokenContentIsNamed) {
  EXPECT_THAT(error_of([&] { load(sample("vdb/hydrogen_posdensity_negative_values.vdb")); }),
              AllOf(HasSubstr("posdensity"), HasSubstr("1 voxel is NaN")));
  EXPECT_THAT(error_of([&] { load(sample("vdb/cortex_points.vdb")); }),
              AllOf(HasSubstr("points: points"), HasSubstr("5 active voxels")));
  EXPECT_THAT(error_of([&] { load(sample("vdb/zeno_vel_vec3s_tiles.vdb")); }),
              AllOf(HasSubstr("vel: vec3 float"), HasSubstr("1000000 active voxels")));
}

TEST_F(SampleFileLaw, NothingToSeeIsVacuum) {
  for (const char* file :
       {"vdb/tinyvdb_sphere_div1_all_zero.vdb", "vdb/usd_smoke_000001_empty_grids.vdb"}) {
    const auto grid = load(sample(file));
    EXPECT_THAT(test::in_words(notices_), ::testing::ElementsAre(HasSubstr("vacuum"))) << file;
    EXPECT_EQ(voxel(*grid, 0, 0, 0), 0.0f);
  }
  EXPECT_EQ(list_grids(sample("vdb/usd_smoke_000001_empty_grids.vdb")).size(), 4u);
}

TEST_F(SampleFileLaw, DenseVolumesAreRead) {
  const std::string folder = "mitsuba/lajolla_volpath_test/";
  const auto smoke = load(sample(folder + "smoke.vol"));
  EXPECT_EQ(smoke->box().max, Vec3(127.5f, 127.5f, 49.5f));
  int nonzero = 0;
  GridLookup<float> lookup(*smoke);
  for (int z = 0; z < 50; ++z)
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x) nonzero += lookup.nearest(Vec3(x, y, z)) != 0.0f;
  EXPECT_EQ(nonzero, 312306);

  notices_ = {};
  const auto albedo = load_colour(sample(folder + "albedo.vol"));
  EXPECT_THAT(test::in_words(notices_), IsEmpty());
  EXPECT_EQ(GridLookup<Rgb>(*albedo).nearest({79, 79, 39}), Rgb(0.9f));
  load_colour(sample(folder + "colored_density.vol"));
  EXPECT_THAT(test::in_words(notices_),
              ::testing::ElementsAre(HasSubstr("negative voxels were set to 0")));
}

}  // namespace
}  // namespace brume
