// SPDX-License-Identifier: Apache-2.0
#include "io/grid_to_nano.h"

#include <malloc.h>
#include <nanovdb/NanoVDB.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "core/huge_pages.h"

namespace brume {
namespace {

float to_nano(float v) {
  return v;
}
nanovdb::Vec3f to_nano(const openvdb::Vec3f& v) {
  return {v.x(), v.y(), v.z()};
}
nanovdb::Coord to_nano(const openvdb::Coord& ijk) {
  return {ijk.x(), ijk.y(), ijk.z()};
}

/// Lays out a grid as nanovdb::openToNanoVDB does: header, tree, root and its table, then the nodes
/// of each level, the largest first.
template <class OpenTree, class Build>
class NanoWriter {
  using OpenRoot = typename OpenTree::RootNodeType;
  using Root = nanovdb::NanoRoot<Build>;
  using Upper = nanovdb::NanoUpper<Build>;
  using Lower = nanovdb::NanoLower<Build>;
  using Leaf = nanovdb::NanoLeaf<Build>;

 public:
  nanovdb::GridHandle<nanovdb::HostBuffer> write(OpenTree& tree) {
    OpenRoot& root = tree.root();
    const std::vector<openvdb::Index32> count = tree.nodeCount();  // leaves first
    const std::uint64_t tree_at = sizeof(nanovdb::GridData);
    const std::uint64_t root_at = tree_at + sizeof(nanovdb::TreeData<3>);
    const std::uint64_t table_bytes = root.getTableSize() * sizeof(typename Root::DataType::Tile);
    const std::uint64_t upper_at = root_at + sizeof(typename Root::DataType) + table_bytes;
    const std::uint64_t lower_at = upper_at + count[Upper::LEVEL] * sizeof(Upper);
    const std::uint64_t leaf_at = lower_at + count[Lower::LEVEL] * sizeof(Lower);
    const std::uint64_t size = leaf_at + count[Leaf::LEVEL] * sizeof(Leaf);

    auto buffer = nanovdb::HostBuffer::create(size);
    std::uint8_t* data = buffer.data();
    if (data == nullptr) throw std::bad_alloc();
    prefer_huge_pages(data, size);
    std::memset(data, 0, upper_at);
    upper_ = reinterpret_cast<Upper*>(data + upper_at);
    lower_ = reinterpret_cast<Lower*>(data + lower_at);
    leaf_ = reinterpret_cast<Leaf*>(data + leaf_at);

    auto& grid = *reinterpret_cast<nanovdb::GridData*>(data);
    grid.mMagic = NANOVDB_MAGIC_NUMBER;
    grid.mVersion = nanovdb::Version();
    grid.mFlags = std::uint32_t(nanovdb::GridFlags::IsBreadthFirst);
    grid.mGridCount = 1;
    grid.mGridSize = size;
    grid.mMap = nanovdb::Map();
    grid.mVoxelSize = nanovdb::Vec3R(1.0);
    grid.mGridType = nanovdb::mapToGridType<Build>();

    auto& nano_tree = *reinterpret_cast<nanovdb::TreeData<3>*>(data + tree_at);
    nano_tree.mNodeOffset[Root::LEVEL] = root_at - tree_at;
    nano_tree.mNodeOffset[Upper::LEVEL] = upper_at - tree_at;
    nano_tree.mNodeOffset[Lower::LEVEL] = lower_at - tree_at;
    nano_tree.mNodeOffset[Leaf::LEVEL] = leaf_at - tree_at;
    std::copy_n(count.begin(), 3, nano_tree.mNodeCount);
    nano_tree.mVoxelCount = tree.activeVoxelCount();

    write_root(root, *reinterpret_cast<typename Root::DataType*>(data + root_at));
    return nanovdb::GridHandle<nanovdb::HostBuffer>(std::move(buffer));
  }

 private:
  void write_root(OpenRoot& open, typename Root::DataType& nano) {
    nano.mBackground = to_nano(open.background());
    nano.mTableSize = 0;
    for (auto child = open.beginChildAll(); child; ++child) {
      auto* tile = nano.tile(nano.mTableSize++);
      typename OpenTree::ValueType value;
      if (auto* upper = child.probeChild(value))
        tile->setChild(to_nano(child.getCoord()), write_internal(*upper, upper_, lower_), &nano);
      else
        tile->setValue(to_nano(child.getCoord()), child.isValueOn(), to_nano(value));
    }
  }

  /// Fills the next of the nodes at `place` and returns it. `child_place` is where children go.
  template <class Open, class Node, class Child>
  Node* write_internal(Open& open, Node*& place, Child*& child_place) {
    Node* node = place++;
    auto& nano = *node->data();
    std::memset(static_cast<void*>(&nano), 0, sizeof nano);
    nano.setOrigin(to_nano(open.origin()));
    for (openvdb::Index n = 0; n < Open::NUM_VALUES; ++n) {
      if (!open.isChildMaskOn(n)) {
        nano.mTable[n].value = to_nano(open.getTable()[n].getValue());
        if (open.isValueMaskOn(n)) nano.mValueMask.setOn(n);
        continue;
      }
      auto* child = open.getTable()[n].getChild();
      nano.mChildMask.setOn(n);
      if constexpr (Child::LEVEL == 0) {
        nano.setChild(n, write_leaf(*child));
        open.addTile(n, openvdb::zeroVal<typename Open::ValueType>(), false);  // deletes the leaf
        give_back_memory();
      } else {
        nano.setChild(n, write_internal(*child, child_place, leaf_));
      }
    }
    return node;
  }

  template <class Open>
  Leaf* write_leaf(const Open& open) {
    Leaf* leaf = leaf_++;
    auto& nano = *leaf->data();
    nano.setOrigin(to_nano(open.origin()));
    std::memset(nano.mBBoxDif, 0, sizeof nano.mBBoxDif);
    nano.mFlags = 0;
    static_assert(sizeof nano.mValueMask == sizeof open.getValueMask());  // 512 bits, x slowest
    std::memcpy(static_cast<void*>(&nano.mValueMask), &open.getValueMask(), sizeof nano.mValueMask);
    const auto* values = open.buffer().data();
    for (openvdb::Index i = 0; i < Open::SIZE; ++i) nano.mValues[i] = to_nano(values[i]);
    nano.mMinimum = nano.mMaximum = {};
    nano.mAverage = nano.mStdDevi = {};
    return leaf;
  }

  /// Returns pages of deleted leaves to the system, which an allocator of small blocks does not do
  /// on its own.
  void give_back_memory() {
    constexpr std::uint64_t kInterval = std::uint64_t(16) << 20;  // [bytes]
    if (++deleted_ % (kInterval / sizeof(Leaf)) == 0) malloc_trim(0);
  }

  Upper* upper_ = nullptr;
  Lower* lower_ = nullptr;
  Leaf* leaf_ = nullptr;
  std::uint64_t deleted_ = 0;  // leaves
};

}  // namespace

nanovdb::GridHandle<nanovdb::HostBuffer> grid_to_nano(openvdb::FloatTree& tree) {
  return NanoWriter<openvdb::FloatTree, float>().write(tree);
}

nanovdb::GridHandle<nanovdb::HostBuffer> grid_to_nano(openvdb::Vec3STree& tree) {
  return NanoWriter<openvdb::Vec3STree, nanovdb::Vec3f>().write(tree);
}

}  // namespace brume
