// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nanovdb/util/IO.h>
#include <openvdb/openvdb.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "io/consumable_buffer.h"
#include "io/grid_file.h"
#include "io/grid_from_nano.h"
#include "io/nvdb_data.h"

namespace brume {
namespace {

using nanovdb::io::GridMetaData;

std::string value_type_in_words(nanovdb::GridType type) {
  using Type = nanovdb::GridType;
  switch (type) {
    case Type::Float:
      return "float";
    case Type::Double:
      return "double";
    case Type::Fp4:
      return "4-bit float";
    case Type::Fp8:
      return "8-bit float";
    case Type::Fp16:
      return "16-bit float";
    case Type::FpN:
      return "variable-bit float";
    case Type::Vec3f:
      return "vec3 float";
    case Type::Vec3d:
      return "vec3 double";
    default:
      return type < Type::End ? nanovdb::toStr(type) : "unknown type";
  }
}

std::string class_in_words(nanovdb::GridClass grid_class) {
  using Class = nanovdb::GridClass;
  switch (grid_class) {
    case Class::LevelSet:
      return "level set";
    case Class::FogVolume:
      return "fog volume";
    case Class::Staggered:
      return "staggered";
    case Class::PointIndex:
    case Class::PointData:
      return "points";
    default:
      return "no class";
  }
}

int channels_of(const nanovdb::io::MetaData& grid) {
  using Type = nanovdb::GridType;
  if (grid.gridClass == nanovdb::GridClass::PointIndex ||
      grid.gridClass == nanovdb::GridClass::PointData)
    return 0;
  switch (grid.gridType) {
    case Type::Float:
    case Type::Double:
    case Type::Fp4:
    case Type::Fp8:
    case Type::Fp16:
    case Type::FpN:
      return 1;
    case Type::Vec3f:
    case Type::Vec3d:
      return 3;
    default:
      return 0;
  }
}

/// What the file says of the grid at `data`, for one that it does not list.
GridMetaData read_meta_data(const std::uint8_t* data, std::uint64_t left) {
  constexpr std::uint64_t kTree = sizeof(nanovdb::GridData);
  constexpr std::uint64_t kHeaders = kTree + sizeof(nanovdb::TreeData<3>);
  const auto throw_outside = [] { throw std::runtime_error("a grid lies outside the data"); };
  if (left < kHeaders) throw_outside();
  const auto& grid = *reinterpret_cast<const nanovdb::GridData*>(data);
  if (grid.mMagic != NANOVDB_MAGIC_NUMBER) throw std::runtime_error("not a NanoVDB grid");
  if (grid.mGridSize > left || grid.mGridSize < kHeaders ||
      grid.mGridSize % NANOVDB_DATA_ALIGNMENT != 0)
    throw_outside();
  const auto& tree = *reinterpret_cast<const nanovdb::TreeData<3>*>(data + kTree);
  GridMetaData meta;
  meta.gridSize = grid.mGridSize;
  meta.voxelCount = tree.mVoxelCount;
  meta.gridType = grid.mGridType;
  meta.gridClass = grid.mGridClass;
  meta.voxelSize = grid.mVoxelSize;
  meta.gridName.assign(grid.mGridName, ::strnlen(grid.mGridName, sizeof grid.mGridName));
  // A root of any type begins with its bounding box.
  const std::uint64_t root = tree.mNodeOffset[3], root_end = grid.mGridSize - kTree;
  if (root > root_end || root_end - root < sizeof meta.indexBBox) throw_outside();
  std::memcpy(&meta.indexBBox, data + kTree + root, sizeof meta.indexBBox);
  return meta;
}

/// Data of one grid, or of several one after the other, as it is packed in the file.
struct Pack {
  NvdbCodec codec;
  std::int64_t position;            // in the file
  std::uint64_t packed_size, size;  // [bytes]
};

/// A grid within the unpacked data.
struct Entry {
  std::size_t pack;
  std::uint64_t offset;  // [bytes]
  GridMetaData meta;
};

/// NanoVDB trusts every length and offset of a file; here they are held against what is left of it.
class NvdbFile final : public GridFile {
 public:
  explicit NvdbFile(const std::string& path)
      : path_(path),
        stream_(path, std::ios::binary),
        size_(std::int64_t(std::filesystem::file_size(path))) {
    stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::initialize();
    with_clear_errors(path_, [&] {
      while (stream_.tellg() < size_) read_segment();
    });
  }

  std::vector<GridSummary> summaries() override {
    std::vector<GridSummary> result;
    for (const Entry& entry : entries_) {
      const auto& m = entry.meta;
      GridSummary summary{.name = m.gridName,
                          .value_type = value_type_in_words(m.gridType),
                          .grid_class = class_in_words(m.gridClass),
                          .channels = channels_of(m)};
      GridSummary::Extent extent{.active_voxels = m.voxelCount, .memory_bytes = m.gridSize};
      if (m.voxelCount > 0) {
        extent.min = {m.indexBBox.min()[0], m.indexBBox.min()[1], m.indexBBox.min()[2]};
        extent.max = {m.indexBBox.max()[0], m.indexBBox.max()[1], m.indexBBox.max()[2]};
      }
      summary.extent = extent;
      summary.voxel_size = glm::dvec3(m.voxelSize[0], m.voxelSize[1], m.voxelSize[2]);
      result.push_back(std::move(summary));
    }
    return result;
  }

  openvdb::GridBase::Ptr read(std::size_t index) override {
    const Entry& entry = entries_[index];
    openvdb::GridBase::Ptr grid;
    with_clear_errors(fmt::format("{}: grid \"{}\"", path_, entry.meta.gridName), [&] {
      const Pack& pack = packs_[entry.pack];
      ConsumableBuffer data(pack.size);
      unpack(pack, data.data(), data.size());
      grid = grid_from_nano(data, entry.offset, entry.meta.gridSize,
                            std::uint32_t(entry.meta.gridType));
    });
    return grid;
  }

 private:
  void read_segment() {
    nanovdb::io::Header header;
    stream_.read(reinterpret_cast<char*>(&header), sizeof header);
    if (header.magic != NANOVDB_MAGIC_NUMBER) throw std::runtime_error("not a NanoVDB segment");
    if (header.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER)
      throw Error(fmt::format("{}: NanoVDB format {} is not supported; expected {}.x", path_,
                              header.version.c_str(), NANOVDB_MAJOR_VERSION_NUMBER));
    std::vector<GridMetaData> grids(header.gridCount);
    for (GridMetaData& meta : grids) {
      stream_.read(reinterpret_cast<char*>(static_cast<nanovdb::io::MetaData*>(&meta)),
                   sizeof(nanovdb::io::MetaData));
      if (meta.nameSize > size_ - stream_.tellg()) throw std::runtime_error("the name is too long");
      std::string name(meta.nameSize, '\0');
      stream_.read(name.data(), std::streamsize(name.size()));
      meta.gridName = name.substr(0, name.find('\0'));
    }
    for (const GridMetaData& meta : grids) {
      const Pack pack{NvdbCodec(header.codec), stream_.tellg(), meta.fileSize, meta.gridSize};
      const std::uint64_t left = std::uint64_t(size_ - pack.position);
      if (pack.packed_size > left)
        throw Error(fmt::format("{}: truncated: grid \"{}\" has {} bytes, {} are left", path_,
                                meta.gridName, pack.packed_size, left));
      constexpr std::uint64_t kMaxExpansion = 2048;  // beyond what Zip and Blosc reach
      if (pack.size / kMaxExpansion > pack.packed_size)
        throw std::runtime_error(
            fmt::format("{} bytes cannot expand to {}", pack.packed_size, pack.size));
      packs_.push_back(pack);
      with_clear_errors(fmt::format("{}: grid \"{}\"", path_, meta.gridName),
                        [&] { list_grids_of(pack, meta); });
      stream_.seekg(pack.position + std::int64_t(pack.packed_size));
    }
  }

  /// Adds the grids of the last pack. The file lists the first; whether others follow in the data,
  /// and which, stands only there.
  void list_grids_of(const Pack& pack, const GridMetaData& listed) {
    const std::size_t index = packs_.size() - 1;
    nanovdb::GridData first;
    if (pack.size < sizeof first) throw std::runtime_error("too short for a grid");
    unpack(pack, reinterpret_cast<std::uint8_t*>(&first), sizeof first);
    if (first.mGridCount <= 1 || first.mGridSize >= pack.size) {
      entries_.push_back({index, 0, listed});
      return;
    }
    ConsumableBuffer data(pack.size);
    unpack(pack, data.data(), data.size());
    std::uint64_t offset = 0;
    for (std::uint32_t i = 0; i < first.mGridCount; ++i) {
      entries_.push_back({index, offset, read_meta_data(data.data() + offset, pack.size - offset)});
      offset += entries_.back().meta.gridSize;
    }
  }

  /// The first `size` bytes of the data.
  void unpack(const Pack& pack, std::uint8_t* out, std::uint64_t size) {
    stream_.seekg(pack.position);
    unpack_nvdb(stream_, pack.codec, pack.packed_size, pack.size, out, size);
  }

  std::string path_;
  std::ifstream stream_;
  std::int64_t size_;  // [bytes]
  std::vector<Pack> packs_;
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<GridFile> open_nvdb_file(const std::string& path) {
  return std::make_unique<NvdbFile>(path);
}

}  // namespace brume
