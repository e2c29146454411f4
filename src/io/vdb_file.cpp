// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <openvdb/io/Compression.h>
#include <openvdb/openvdb.h>

#include "core/error.h"
#include "io/grid_file.h"
#include "io/vdb_stream.h"

namespace brume {
namespace {

// The file format is parsed here down to the trees, and OpenVDB reads only those: it trusts every
// length it finds, refuses a file over one grid of a type it does not know, and goes on reading
// when the file has ended. Our stream throws at its end, and lengths are compared with what is
// left.
//
//     magic, versions, "has offsets", uuid | file metadata | grid count |
//     per grid: name, type, name of the grid whose tree it shares, 3 positions |
//               compression, metadata, transform, topology | voxel values |

constexpr std::uint32_t kOldestFormat = 222;  // of OpenVDB 1.1, 2013

struct Entry {
  std::string name, type;
  bool half = false;
  std::string tree_of;  // unique name of the grid whose tree this one shares, or empty
  std::string unique_name;
  std::int64_t grid_position = 0;
};

std::string value_type_in_words(const std::string& type, bool half) {
  const std::string words = type == "vec3s"                              ? "vec3 float"
                            : type == "vec3d"                            ? "vec3 double"
                            : type == "ptdataidx32" || type == "ptidx32" ? "points"
                                                                         : type;
  return half ? "half " + words : words;
}

std::string class_in_words(openvdb::GridClass grid_class) {
  switch (grid_class) {
    case openvdb::GRID_LEVEL_SET:
      return "level set";
    case openvdb::GRID_FOG_VOLUME:
      return "fog volume";
    case openvdb::GRID_STAGGERED:
      return "staggered";
    default:
      return "no class";
  }
}

/// Empty for types that brume never reads.
std::optional<ValueLayout> layout_of(const std::string& value_type, bool half) {
  constexpr int kHalf = 2;
  if (value_type == "float") return ValueLayout{4, half ? kHalf : 4};
  if (value_type == "double") return ValueLayout{8, half ? kHalf : 8};
  if (value_type == "vec3s") return ValueLayout{12, half ? 3 * kHalf : 12};
  if (value_type == "vec3d") return ValueLayout{24, half ? 3 * kHalf : 24};
  if (value_type == "int32") return ValueLayout{4, 4};
  if (value_type == "int64") return ValueLayout{8, 8};
  return std::nullopt;
}

int channels_of(const std::string& value_type) {
  if (value_type == "float" || value_type == "double") return 1;
  if (value_type == "vec3s" || value_type == "vec3d") return 3;
  return 0;
}

GridSummary::Extent extent_of(const openvdb::GridBase& grid) {
  GridSummary::Extent extent;
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  extent.active_voxels = grid.activeVoxelCount();
  if (extent.active_voxels > 0) {
    extent.min = {box.min().x(), box.min().y(), box.min().z()};
    extent.max = {box.max().x(), box.max().y(), box.max().z()};
  }
  extent.memory_bytes = grid.memUsage();
  return extent;
}

/// What the writer recorded about the grid; empty when it did not.
std::optional<GridSummary::Extent> recorded_extent(const openvdb::GridBase& grid) {
  using openvdb::GridBase;
  const auto count = grid.getMetadata<openvdb::Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT);
  const auto min = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MIN);
  const auto max = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MAX);
  const auto bytes = grid.getMetadata<openvdb::Int64Metadata>(GridBase::META_FILE_MEM_BYTES);
  if (!count || !min || !max || !bytes) return std::nullopt;
  GridSummary::Extent extent{.active_voxels = std::uint64_t(count->value()),
                             .memory_bytes = std::uint64_t(bytes->value())};
  if (extent.active_voxels > 0) {
    extent.min = {min->value().x(), min->value().y(), min->value().z()};
    extent.max = {max->value().x(), max->value().y(), max->value().z()};
  }
  return extent;
}

class VdbFile final : public GridFile {
 public:
  explicit VdbFile(const std::string& path) : path_(path), file_(path) {
    openvdb::initialize();
    with_clear_errors(path_, [&] { read_directory(); });
  }

  std::vector<GridSummary> summaries() override {
    std::vector<GridSummary> result;
    for (std::size_t i = 0; i < entries_.size(); ++i) result.push_back(summary(i));
    return result;
  }

  openvdb::GridBase::Ptr read(std::size_t index) override {
    const Entry& entry = entries_[index];
    openvdb::GridBase::Ptr grid;
    with_clear_errors(fmt::format("{}: grid \"{}\"", path_, entry.name),
                      [&] { grid = has_offsets_ ? read_at_offset(entry) : streamed_[index]; });
    return grid;
  }

 private:
  void read_directory() {
    const auto magic = file_.read<std::int64_t>();
    if (magic != openvdb::OPENVDB_MAGIC) throw std::runtime_error("not an OpenVDB file");
    const auto format = file_.read<std::uint32_t>();
    if (format < kOldestFormat || format > openvdb::OPENVDB_FILE_VERSION)
      throw Error(fmt::format("{}: OpenVDB file format {} is not supported; expected {} to {}",
                              path_, format, kOldestFormat, openvdb::OPENVDB_FILE_VERSION));
    const auto major = file_.read<std::uint32_t>();
    const auto minor = file_.read<std::uint32_t>();
    has_offsets_ = file_.read<char>() != 0;
    openvdb::io::setVersion(file_.stream(), {major, minor}, format);
    constexpr int kUuidLength = 36;
    file_.seek(file_.position() + kUuidLength);
    file_.skip_metadata();

    const auto count = file_.read<std::int32_t>();
    if (count < 0) throw std::runtime_error(fmt::format("a count of {} grids", count));
    for (int i = 0; i < count; ++i) read_entry();
  }

  void read_entry() {
    constexpr std::string_view kHalfSuffix = "_HalfFloat";
    constexpr char kCopySeparator = '\x1e';  // "density\x1e1" is the second grid called "density"
    Entry entry;
    entry.unique_name = file_.read_string();
    entry.name = entry.unique_name.substr(0, entry.unique_name.find(kCopySeparator));
    entry.type = file_.read_string();
    if (entry.type.ends_with(kHalfSuffix)) {
      entry.half = true;
      entry.type.resize(entry.type.size() - kHalfSuffix.size());
    }
    entry.tree_of = file_.read_string();
    entry.grid_position = file_.read<std::int64_t>();
    file_.read<std::int64_t>();  // of the voxel values, which follow the topology anyway
    const auto end = file_.read<std::int64_t>();
    if (has_offsets_) {
      if (end > file_.size())
        throw Error(fmt::format("{}: truncated: grid \"{}\" ends at byte {}, the file at byte {}",
                                path_, entry.name, end, file_.size()));
      if (entry.grid_position < file_.position() || end < entry.grid_position)
        throw std::runtime_error("grids overlap");
      file_.seek(end);
    } else {
      // Written to a pipe: the only way to the next grid is through this one.
      if (!openvdb::GridBase::isRegistered(entry.type))
        throw std::runtime_error(fmt::format("grid type \"{}\" is unknown", entry.type));
      streamed_.push_back(read_here(entry));
    }
    entries_.push_back(entry);
  }

  openvdb::GridBase::Ptr read_at_offset(const Entry& entry) {
    file_.seek(entry.grid_position);
    return read_here(entry);
  }

  openvdb::GridBase::Ptr read_here(const Entry& entry) {
    openvdb::GridBase::Ptr grid = open_here(entry);
    if (entry.tree_of.empty()) {
      read_tree(*grid);
      return grid;
    }
    const auto owner = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.unique_name == entry.tree_of && e.tree_of.empty() && e.type == entry.type;
    });
    if (owner == entries_.end())
      throw std::runtime_error(
          fmt::format("it shares the voxels of \"{}\", which is missing", entry.tree_of));
    const auto shared =
        has_offsets_ ? read_at_offset(*owner) : streamed_[std::size_t(owner - entries_.begin())];
    grid->setTree(shared->baseTreePtr());
    return grid;
  }

  /// Reads all but the tree.
  openvdb::GridBase::Ptr open_here(const Entry& entry) {
    openvdb::io::setDataCompression(file_.stream(), file_.read<std::uint32_t>());
    const std::int64_t metadata = file_.position();
    file_.skip_metadata();
    const std::int64_t transform = file_.position();
    const std::string transform_type = file_.read_string();
    if (!openvdb::math::MapRegistry::isRegistered(transform_type))
      throw std::runtime_error(fmt::format("unknown transform \"{}\"", transform_type));

    openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(entry.type);
    file_.seek(metadata);
    grid->readMeta(file_.stream());
    grid->setSaveFloatAsHalf(entry.half);
    openvdb::io::setGridClass(file_.stream(), grid->getGridClass());
    file_.seek(transform);
    grid->readTransform(file_.stream());
    return grid;
  }

  void read_tree(openvdb::GridBase& grid) {
    const auto layout = layout_of(grid.valueType(), grid.saveFloatAsHalf());
    if (!layout)
      throw std::runtime_error(fmt::format("its values of type {} cannot be read",
                                           value_type_in_words(grid.valueType(), false)));
    const std::int64_t position = file_.position();
    check_tree(file_, *layout, openvdb::io::getDataCompression(file_.stream()));
    file_.seek(position);
    grid.readTopology(file_.stream());
    grid.readBuffers(file_.stream());
  }

  GridSummary summary(std::size_t index) {
    const Entry& entry = entries_[index];
    GridSummary result{.name = entry.name};
    if (!openvdb::GridBase::isRegistered(entry.type)) {
      result.value_type = fmt::format("unknown type \"{}\"", entry.type);
      result.grid_class = "no class";
      return result;
    }
    const openvdb::GridBase::Ptr empty = openvdb::GridBase::createGrid(entry.type);
    result.value_type = value_type_in_words(empty->valueType(), entry.half);
    result.channels = channels_of(empty->valueType());
    with_clear_errors(fmt::format("{}: grid \"{}\"", path_, entry.name), [&] {
      if (has_offsets_) file_.seek(entry.grid_position);
      openvdb::GridBase::Ptr grid = has_offsets_ ? open_here(entry) : streamed_[index];
      result.grid_class = class_in_words(grid->getGridClass());
      const openvdb::Vec3d size = grid->voxelSize();
      result.voxel_size = glm::dvec3(size.x(), size.y(), size.z());
      result.extent = recorded_extent(*grid);
      if (!result.extent && layout_of(grid->valueType(), entry.half))
        result.extent = extent_of(*read(index));
    });
    return result;
  }

  std::string path_;
  VdbStream file_;
  bool has_offsets_ = true;
  std::vector<Entry> entries_;
  std::vector<openvdb::GridBase::Ptr> streamed_;  // one an entry, only without offsets
};

}  // namespace

std::unique_ptr<GridFile> open_vdb_file(const std::string& path) {
  return std::make_unique<VdbFile>(path);
}

}  // namespace brume
