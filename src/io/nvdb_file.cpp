// SPDX-License-Identifier: Apache-2.0
#include <blosc.h>
#include <fmt/format.h>
#include <nanovdb/util/IO.h>
#include <openvdb/openvdb.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "io/grid_file.h"
#include "io/grid_from_nano.h"

namespace brume {
namespace {

using Handle = nanovdb::GridHandle<nanovdb::HostBuffer>;

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

struct Entry {
  nanovdb::io::GridMetaData meta;
  nanovdb::io::Codec codec;
  std::int64_t position;  // of the data in the file
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
    const std::string label = fmt::format("{}: grid \"{}\"", path_, entry.meta.gridName);
    openvdb::GridBase::Ptr grid;
    with_clear_errors(label, [&] {
      Handle handle(nanovdb::HostBuffer::create(entry.meta.gridSize));
      stream_.seekg(entry.position);
      read_data(entry, handle);
      grid = grid_from_nano(handle.data(), handle.size(), std::uint32_t(entry.meta.gridType));
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
    std::vector<Entry> segment(header.gridCount);
    for (Entry& entry : segment) {
      auto& meta = entry.meta;
      stream_.read(reinterpret_cast<char*>(static_cast<nanovdb::io::MetaData*>(&meta)),
                   sizeof(nanovdb::io::MetaData));
      if (meta.nameSize > size_ - stream_.tellg()) throw std::runtime_error("the name is too long");
      std::string name(meta.nameSize, '\0');
      stream_.read(name.data(), std::streamsize(name.size()));
      meta.gridName = name.substr(0, name.find('\0'));
      entry.codec = header.codec;
    }
    for (Entry& entry : segment) {
      entry.position = stream_.tellg();
      const std::uint64_t left = std::uint64_t(size_ - entry.position);
      if (entry.meta.fileSize > left)
        throw Error(fmt::format("{}: truncated: grid \"{}\" has {} bytes, {} are left", path_,
                                entry.meta.gridName, entry.meta.fileSize, left));
      constexpr std::uint64_t kMaxExpansion = 2048;  // beyond what Zip and Blosc reach
      if (entry.meta.gridSize / kMaxExpansion > entry.meta.fileSize)
        throw std::runtime_error(
            fmt::format("{} bytes cannot expand to {}", entry.meta.fileSize, entry.meta.gridSize));
      stream_.seekg(entry.position + std::int64_t(entry.meta.fileSize));
      entries_.push_back(std::move(entry));
    }
  }

  /// Blocks of at most 1 GB, each preceded by its compressed size; uncompressed data is bare.
  void read_data(const Entry& entry, Handle& handle) {
    char* out = reinterpret_cast<char*>(handle.data());
    std::uint64_t left = handle.size();
    if (entry.codec == nanovdb::io::Codec::NONE) {
      if (entry.meta.fileSize != left) throw std::runtime_error("its two sizes differ");
      stream_.read(out, std::streamsize(left));
      return;
    }
    const bool zip = entry.codec == nanovdb::io::Codec::ZIP;
    while (left > 0) {
      std::uint64_t packed_size = 0;
      stream_.read(reinterpret_cast<char*>(&packed_size), sizeof packed_size);
      if (packed_size > entry.meta.fileSize) throw std::runtime_error("a block is too long");
      std::vector<char> packed(packed_size);
      stream_.read(packed.data(), std::streamsize(packed_size));
      constexpr std::uint64_t kBlock = std::uint64_t(1) << 30;
      const std::uint64_t size = zip ? left : std::min(left, kBlock);
      if (!(zip ? unzip(packed, out, size) : unblosc(packed, out, size)))
        throw std::runtime_error("its compressed data is damaged");
      out += size;
      left -= size;
    }
  }

  static bool unzip(const std::vector<char>& packed, char* out, std::uint64_t size) {
    uLongf got = size;
    return uncompress(reinterpret_cast<Bytef*>(out), &got,
                      reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
           got == size;
  }

  static bool unblosc(const std::vector<char>& packed, char* out, std::uint64_t size) {
    std::size_t expected = 0;
    return blosc_cbuffer_validate(packed.data(), packed.size(), &expected) == 0 &&
           expected == size &&
           blosc_decompress_ctx(packed.data(), out, size, /*threads=*/1) == std::int64_t(size);
  }

  std::string path_;
  std::ifstream stream_;
  std::int64_t size_;  // [bytes]
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<GridFile> open_nvdb_file(const std::string& path) {
  return std::make_unique<NvdbFile>(path);
}

}  // namespace brume
