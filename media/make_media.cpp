// SPDX-License-Identifier: Apache-2.0
//
// Makes the volumes of this folder: make_media FOLDER [NAME]... See README.md.

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "media.h"

namespace brume::media {
namespace {

openvdb::math::Transform::Ptr placement(double voxel_size, const openvdb::Vec3d& first_voxel) {
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_size);
  transform->postTranslate(first_voxel);
  return transform;
}

/// Voxels of at least `threshold` as a fog volume; half floats on disk.
openvdb::FloatGrid::Ptr to_fog(const std::string& name, const DenseGrid<float>& values,
                               float threshold, const openvdb::math::Transform::Ptr& transform) {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  auto accessor = grid->getAccessor();
  for (int z = 0; z < values.size().z; ++z)
    for (int y = 0; y < values.size().y; ++y)
      for (int x = 0; x < values.size().x; ++x)
        if (values(x, y, z) >= threshold) accessor.setValue({x, y, z}, values(x, y, z));
  openvdb::tools::prune(grid->tree());
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(transform);
  grid->setSaveFloatAsHalf(true);
  grid->setCreator("brume make_media");
  return grid;
}

/// Colours where `mask` has voxels, and two voxels around: interpolation never meets the black
/// background.
openvdb::Vec3SGrid::Ptr to_colors(const std::string& name, const DenseGrid<glm::vec3>& values,
                                  const openvdb::FloatGrid& mask) {
  const auto grid = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
  auto accessor = grid->getAccessor();
  for (auto voxel = mask.cbeginValueOn(); voxel; ++voxel)
    for (auto ijk = voxel.getBoundingBox().expandBy(2).begin(); ijk; ++ijk) {
      const openvdb::Coord c = *ijk;
      if (!values.contains(c.x(), c.y(), c.z()) || accessor.isValueOn(c)) continue;
      const glm::vec3 v = values(c.x(), c.y(), c.z());
      accessor.setValue(c, {v.r, v.g, v.b});
    }
  grid->setName(name);
  grid->setVectorType(openvdb::VEC_INVARIANT);
  grid->setTransform(mask.transformPtr()->copy());
  grid->setSaveFloatAsHalf(true);
  grid->setCreator("brume make_media");
  return grid;
}

// World units are metres; the ground is y = 0 and the middle x = z = 0.
openvdb::math::Transform::Ptr centered(const glm::ivec3& n, double voxel_size, double bottom) {
  return placement(voxel_size, {-0.5 * voxel_size * (n.x - 1), bottom + 0.5 * voxel_size,
                                -0.5 * voxel_size * (n.z - 1)});
}

constexpr float kThreshold = 1.0f / 256.0f;  // less density is left out

openvdb::GridPtrVec cloud_grids() {
  const DenseGrid<float> cloud = make_cloud();
  return {to_fog("density", cloud, kThreshold, centered(cloud.size(), 4.0, 600.0))};
}

openvdb::GridPtrVec fog_bank_grids() {
  const DenseGrid<float> fog = make_fog_bank();
  return {to_fog("density", fog, kThreshold, centered(fog.size(), 1.0, 0.0))};
}

openvdb::GridPtrVec constant_grids() {
  const DenseGrid<float> constant(glm::ivec3(16), 1.0f);
  return {to_fog("density", constant, kThreshold, centered(constant.size(), 1.0 / 16.0, 0.0))};
}

openvdb::GridPtrVec smoke_grids() {
  const Smoke smoke = make_smoke();
  const auto transform = centered(smoke.density.size(), 0.025, 0.0);
  const auto density = to_fog("density", smoke.density, kThreshold, transform);
  return {density, to_colors("albedo", smoke.albedo, *density),
          to_fog("temperature", smoke.temperature, kThreshold, transform->copy())};
}

struct Maker {
  const char* name;
  openvdb::GridPtrVec (*make)();
};
constexpr Maker kMakers[] = {{"cloud", cloud_grids},
                             {"fog_bank", fog_bank_grids},
                             {"constant", constant_grids},
                             {"smoke", smoke_grids}};

void write(const std::string& folder, const Maker& maker) {
  const std::string path = folder + "/" + maker.name + ".vdb";
  openvdb::io::File file(path);
  file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
  file.write(maker.make());
  std::printf("%s\n", path.c_str());
}

}  // namespace
}  // namespace brume::media

int main(int argc, char** argv) {
  using brume::media::kMakers;
  const std::vector<std::string_view> names(argv + std::min(argc, 2), argv + argc);
  const bool known = std::all_of(names.begin(), names.end(), [](std::string_view name) {
    return std::any_of(std::begin(kMakers), std::end(kMakers),
                       [&](const auto& maker) { return maker.name == name; });
  });
  if (argc < 2 || !known) {
    std::fputs("usage: make_media FOLDER [cloud | fog_bank | constant | smoke]...\n", stderr);
    return 2;
  }
  try {
    openvdb::initialize();
    for (const auto& maker : kMakers)
      if (names.empty() || std::find(names.begin(), names.end(), maker.name) != names.end())
        brume::media::write(argv[1], maker);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
