// SPDX-License-Identifier: Apache-2.0
#include "io/nano_checks.h"

#include <stdexcept>

namespace brume {
namespace {

/// The part of the buffer behind its beginning, as byte offsets.
class Bounds {
 public:
  Bounds(const void* data, std::uint64_t size)
      : data_(static_cast<const std::uint8_t*>(data)), size_(size) {}

  /// Throws unless `bytes` bytes at `base` + `offset` lie inside the buffer, aligned for a node.
  void require(const void* base, std::int64_t offset, std::uint64_t bytes) const {
    const std::int64_t at = static_cast<const std::uint8_t*>(base) - data_;
    // Both are compared before they are added, which could overflow.
    if (offset < -at || offset > std::int64_t(size_) - at ||
        bytes > size_ - std::uint64_t(at + offset))
      throw std::runtime_error("a node lies outside the data");
    if ((at + offset) % NANOVDB_DATA_ALIGNMENT != 0)
      throw std::runtime_error("a node is not aligned");
  }

 private:
  const std::uint8_t* data_;
  std::uint64_t size_;
};

template <class Leaf>
void check_leaf(const Leaf& leaf, const Bounds& bounds) {
  if constexpr (std::is_same_v<typename Leaf::BuildType, nanovdb::FpN>)
    bounds.require(&leaf, 0, leaf.data()->memUsage());  // of variable size
}

/// Checks the children of an internal node, and theirs. `visited` counts nodes of each level: more
/// than the buffer has room for means a loop or a shared node.
template <class Node>
void check_children(const Node& node, const Bounds& bounds, std::uint64_t size,
                    std::uint64_t (&visited)[3]) {
  using Child = typename Node::ChildNodeType;
  for (auto on = node.childMask().beginOn(); on; ++on) {
    const std::int64_t offset = node.data()->mTable[*on].child;
    bounds.require(&node, offset, sizeof(Child));
    if (++visited[Child::LEVEL] > size / sizeof(Child))
      throw std::runtime_error("it has more nodes than fit");
    const Child& child = *node.data()->getChild(*on);
    if constexpr (Child::LEVEL == 0)
      check_leaf(child, bounds);
    else
      check_children(child, bounds, size, visited);
  }
}

template <class Build>
void check_grid(const std::uint8_t* data, std::uint64_t size) {
  using Grid = nanovdb::NanoGrid<Build>;
  using Root = nanovdb::NanoRoot<Build>;
  const auto& grid = *reinterpret_cast<const Grid*>(data);
  const Bounds bounds(data, size);
  const auto* tree = reinterpret_cast<const nanovdb::TreeData<3>*>(&grid.tree());
  bounds.require(tree, 0, sizeof *tree);
  const std::int64_t root_offset = std::int64_t(tree->mNodeOffset[3]);
  bounds.require(tree, root_offset, sizeof(Root));
  const Root& root = grid.tree().root();
  bounds.require(&root, 0, root.memUsage());
  std::uint64_t visited[3] = {0, 0, 0};
  for (std::uint32_t i = 0; i < root.data()->mTableSize; ++i) {
    const auto* tile = root.data()->tile(i);
    if (!tile->isChild()) continue;
    bounds.require(&root, tile->child, sizeof(typename Root::ChildNodeType));
    check_children(*root.data()->getChild(tile), bounds, size, visited);
  }
}

}  // namespace

void make_sound(std::uint8_t* data, std::uint64_t size, nanovdb::GridType expected) {
  auto* grid = reinterpret_cast<nanovdb::GridData*>(data);
  if (size < sizeof(nanovdb::GridData)) throw std::runtime_error("too short for a grid");
  if (grid->mMagic != NANOVDB_MAGIC_NUMBER) throw std::runtime_error("not a NanoVDB grid");
  if (grid->mGridType != expected) throw std::runtime_error("its type differs from the header's");
  grid->mGridName[nanovdb::GridData::MaxNameSize - 1] = '\0';
  grid->setLongGridNameOn(false);
  grid->mBlindMetadataCount = 0;

  using Type = nanovdb::GridType;
  switch (expected) {
    case Type::Float:
      return check_grid<float>(data, size);
    case Type::Double:
      return check_grid<double>(data, size);
    case Type::Fp4:
      return check_grid<nanovdb::Fp4>(data, size);
    case Type::Fp8:
      return check_grid<nanovdb::Fp8>(data, size);
    case Type::Fp16:
      return check_grid<nanovdb::Fp16>(data, size);
    case Type::FpN:
      return check_grid<nanovdb::FpN>(data, size);
    case Type::Vec3f:
      return check_grid<nanovdb::Vec3f>(data, size);
    case Type::Vec3d:
      return check_grid<nanovdb::Vec3d>(data, size);
    default:
      throw std::runtime_error("it has no densities or colours");
  }
}

}  // namespace brume
