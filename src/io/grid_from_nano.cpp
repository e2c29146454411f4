// SPDX-License-Identifier: Apache-2.0
#include "io/grid_from_nano.h"

#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

namespace brume {
namespace {

// A grid in memory (NanoVDB 32, NanoVDB.h). Positions of nodes are relative: those of the tree to
// the tree, those of children to their parent.
//
//     grid | tree: position of the root, count of nodes of each level |
//     root: table of tiles and children by coordinates |
//     nodes of 32^3 = masks, table of tiles and children | nodes of 16^3 | leaves of 8^3 voxels

template <class Build>
struct OpenValue {
  using type = float;  // 4, 8, 16 and variable bits among them
};
template <>
struct OpenValue<double> {
  using type = double;
};
template <>
struct OpenValue<nanovdb::Vec3f> {
  using type = openvdb::Vec3f;
};
template <>
struct OpenValue<nanovdb::Vec3d> {
  using type = openvdb::Vec3d;
};

float to_open(float v) {
  return v;
}
double to_open(double v) {
  return v;
}
template <class T>
openvdb::math::Vec3<T> to_open(const nanovdb::Vec3<T>& v) {
  return {v[0], v[1], v[2]};
}

openvdb::GridClass to_open(nanovdb::GridClass grid_class) {
  switch (grid_class) {
    case nanovdb::GridClass::LevelSet:
      return openvdb::GRID_LEVEL_SET;
    case nanovdb::GridClass::FogVolume:
      return openvdb::GRID_FOG_VOLUME;
    case nanovdb::GridClass::Staggered:
      return openvdb::GRID_STAGGERED;
    default:
      return openvdb::GRID_UNKNOWN;
  }
}

openvdb::math::Transform::Ptr to_open(const nanovdb::Map& map) {
  openvdb::Mat4d m = openvdb::Mat4d::identity();
  m.setMat3(openvdb::Mat3d(map.mMatD));
  m = m.transpose();  // OpenVDB multiplies row vectors, NanoVDB columns
  m.setTranslation(openvdb::Vec3d(map.mVecD));
  return openvdb::math::Transform::createLinearTransform(m);
}

template <class Build>
class NanoReader {
  using OpenTree = typename openvdb::tree::Tree4<typename OpenValue<Build>::type>::Type;
  using OpenGrid = openvdb::Grid<OpenTree>;
  using OpenUpper = typename OpenTree::RootNodeType::ChildNodeType;
  using OpenLeaf = typename OpenTree::LeafNodeType;
  using NanoRoot = nanovdb::NanoRoot<Build>;
  using NanoLeaf = nanovdb::NanoLeaf<Build>;

 public:
  NanoReader(ConsumableBuffer& buffer, std::uint64_t offset, std::uint64_t size)
      : buffer_(buffer), offset_(offset), size_(size), visited_(size / NANOVDB_DATA_ALIGNMENT) {}

  typename OpenGrid::Ptr read() {
    const auto& header = at<nanovdb::GridData>(0, sizeof(nanovdb::GridData));
    constexpr std::uint64_t kTree = sizeof(nanovdb::GridData);
    const auto& tree = at<nanovdb::TreeData<3>>(kTree, sizeof(nanovdb::TreeData<3>));
    if (tree.mNodeOffset[NanoRoot::LEVEL] > size_) throw_outside();
    const std::uint64_t root_position = kTree + tree.mNodeOffset[NanoRoot::LEVEL];
    const auto& root = at<typename NanoRoot::DataType>(root_position, sizeof(NanoRoot));

    const auto grid = OpenGrid::create(to_open(root.mBackground));
    grid->setGridClass(to_open(header.mGridClass));
    grid->setTransform(to_open(header.mMap));
    read_root(root_position, root.mTableSize, grid->tree().root());
    for (std::size_t level = 0; level < count_.size(); ++level)
      if (count_[level] != tree.mNodeCount[level])
        throw std::runtime_error(fmt::format("it has {} nodes of level {} where it counts {}",
                                             count_[level], level, tree.mNodeCount[level]));
    return grid;
  }

 private:
  [[noreturn]] static void throw_outside() {
    throw std::runtime_error("a node lies outside the data");
  }

  /// What lies `position` bytes into the grid, `bytes` long.
  template <class T>
  const T& at(std::uint64_t position, std::uint64_t bytes) const {
    if (position > size_ || bytes > size_ - position) throw_outside();
    if (position % NANOVDB_DATA_ALIGNMENT != 0) throw std::runtime_error("a node is not aligned");
    return *reinterpret_cast<const T*>(buffer_.data() + offset_ + position);
  }

  /// Where the child of a node at `parent` lies. Each node has one parent, or the tree would be a
  /// loop, or grow without end.
  template <class Node>
  std::uint64_t enter_child(std::uint64_t parent, std::int64_t offset) {
    if (offset < -std::int64_t(parent) || offset > std::int64_t(size_ - parent)) throw_outside();
    const std::uint64_t position = parent + std::uint64_t(offset);
    at<typename Node::DataType>(position, sizeof(typename Node::DataType));
    auto visited = visited_[position / NANOVDB_DATA_ALIGNMENT];
    if (visited) throw std::runtime_error("two nodes share a child");
    visited = true;
    ++count_[Node::LEVEL];
    return position;
  }

  void read_root(std::uint64_t position, std::uint64_t tiles,
                 typename OpenTree::RootNodeType& result) {
    using Root = typename NanoRoot::DataType;
    using Tile = typename Root::Tile;
    const auto* table = &at<Tile>(position + sizeof(Root), tiles * sizeof(Tile));
    std::set<openvdb::Coord> origins;
    for (const Tile* tile = table; tile != table + tiles; ++tile) {
      const nanovdb::Coord key = tile->origin();
      const openvdb::Coord origin(key[0], key[1], key[2]);
      if (Root::CoordToKey(key) != tile->key || !origins.insert(origin).second)
        throw std::runtime_error("a tile of its root is out of place");
      if (!tile->isChild()) {
        result.addTile(origin, to_open(tile->value), tile->state != 0);
        continue;
      }
      using Upper = typename NanoRoot::ChildNodeType;
      result.addChild(
          read_internal<Upper, OpenUpper>(enter_child<Upper>(position, tile->child), origin)
              .release());
    }
  }

  template <class Nano, class Open>
  std::unique_ptr<Open> read_internal(std::uint64_t position, const openvdb::Coord& origin) {
    using Child = typename Nano::ChildNodeType;
    const auto& node = at<typename Nano::DataType>(position, sizeof(typename Nano::DataType));
    auto result = std::make_unique<Open>(origin, openvdb::zeroVal<typename Open::ValueType>());
    for (std::uint32_t n = 0; n < Open::NUM_VALUES; ++n) {
      if (!node.mChildMask.isOn(n)) {
        result->addTile(n, to_open(node.mTable[n].value), node.mValueMask.isOn(n));
        continue;
      }
      const std::uint64_t child = enter_child<Child>(position, node.mTable[n].child);
      const openvdb::Coord child_origin = result->offsetToGlobalCoord(n);
      if constexpr (Child::LEVEL == 0)
        result->addChild(read_leaf(child, child_origin).release());
      else
        result->addChild(
            read_internal<Child, typename Open::ChildNodeType>(child, child_origin).release());
    }
    return result;
  }

  std::unique_ptr<OpenLeaf> read_leaf(std::uint64_t position, const openvdb::Coord& origin) {
    using Leaf = typename NanoLeaf::DataType;
    const auto& leaf = at<Leaf>(position, sizeof(Leaf));
    std::uint64_t bytes = sizeof(Leaf);
    if constexpr (std::is_same_v<Build, nanovdb::FpN>) {  // the values lie behind the leaf
      constexpr int kWidest = 16;                         // [bits]
      if (leaf.bitWidth() > kWidest) throw std::runtime_error("a value has too many bits");
      bytes = leaf.memUsage();
      at<Leaf>(position, bytes);
    }
    auto result =
        std::make_unique<OpenLeaf>(origin, openvdb::zeroVal<typename OpenLeaf::ValueType>());
    auto* values = result->buffer().data();
    for (std::uint32_t i = 0; i < OpenLeaf::SIZE; ++i) {
      values[i] = to_open(leaf.getValue(i));
      result->setActiveState(i, leaf.mValueMask.isOn(i));
    }
    buffer_.consume(offset_ + position, bytes);
    return result;
  }

  ConsumableBuffer& buffer_;
  std::uint64_t offset_, size_;                  // [bytes] of the grid in the buffer
  std::vector<bool> visited_;                    // one for each place where a node can begin
  std::array<std::uint32_t, 3> count_{0, 0, 0};  // of nodes by level, leaves first
};

template <class Build>
openvdb::GridBase::Ptr read_as(ConsumableBuffer& data, std::uint64_t offset, std::uint64_t size) {
  return NanoReader<Build>(data, offset, size).read();
}

}  // namespace

openvdb::GridBase::Ptr grid_from_nano(ConsumableBuffer& data, std::uint64_t offset,
                                      std::uint64_t size, std::uint32_t type) {
  const auto* grid = reinterpret_cast<const nanovdb::GridData*>(data.data() + offset);
  if (size < sizeof(nanovdb::GridData)) throw std::runtime_error("too short for a grid");
  if (grid->mMagic != NANOVDB_MAGIC_NUMBER) throw std::runtime_error("not a NanoVDB grid");
  if (std::uint32_t(grid->mGridType) != type)
    throw std::runtime_error("its type differs from the header's");

  using Type = nanovdb::GridType;
  switch (grid->mGridType) {
    case Type::Float:
      return read_as<float>(data, offset, size);
    case Type::Double:
      return read_as<double>(data, offset, size);
    case Type::Fp4:
      return read_as<nanovdb::Fp4>(data, offset, size);
    case Type::Fp8:
      return read_as<nanovdb::Fp8>(data, offset, size);
    case Type::Fp16:
      return read_as<nanovdb::Fp16>(data, offset, size);
    case Type::FpN:
      return read_as<nanovdb::FpN>(data, offset, size);
    case Type::Vec3f:
      return read_as<nanovdb::Vec3f>(data, offset, size);
    case Type::Vec3d:
      return read_as<nanovdb::Vec3d>(data, offset, size);
    default:
      throw std::runtime_error("it has no densities or colours");
  }
}

}  // namespace brume
