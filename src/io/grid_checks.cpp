// SPDX-License-Identifier: Apache-2.0
#include "io/grid_checks.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <tuple>

#include "core/error.h"

namespace brume {
namespace {

bool is_finite(float v) {
  return std::isfinite(v);
}
bool is_finite(const openvdb::Vec3f& v) {
  return v.isFinite();
}
bool is_negative(float v) {
  return v < 0.0f;
}
bool is_negative(const openvdb::Vec3f& v) {
  return v.x() < 0.0f || v.y() < 0.0f || v.z() < 0.0f;
}
float without_negatives(float v) {
  return std::max(v, 0.0f);
}
openvdb::Vec3f without_negatives(const openvdb::Vec3f& v) {
  return {std::max(v.x(), 0.0f), std::max(v.y(), 0.0f), std::max(v.z(), 0.0f)};
}

/// Every tile of the tree, whatever its state; leaf voxels are not visited.
template <class Tree>
auto tiles_of(Tree& tree) {
  auto tile = tree.beginValueAll();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  return tile;
}

}  // namespace

template <class Tree>
void require_sound_tree(const Tree& tree, const std::string& label) {
  constexpr int kMaxCoordinate = 1 << 22;  // a float still tells half a voxel
  const auto require = [&](bool sound, const openvdb::Coord& at) {
    if (!sound)
      throw Error(fmt::format("{}: damaged: a node at voxel ({}, {}, {}) is out of place", label,
                              at.x(), at.y(), at.z()));
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis] < -kMaxCoordinate || at[axis] >= kMaxCoordinate)
        throw Error(
            fmt::format("{}: voxel ({}, {}, {}) is too far out; indices must lie within -{} and {}",
                        label, at.x(), at.y(), at.z(), kMaxCoordinate, kMaxCoordinate));
  };
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord at = leaf->origin();
    require(tree.probeConstLeaf(at) == leaf.getLeaf() && (at & 7) == openvdb::Coord(0), at);
  }
  for (auto tile = tiles_of(tree); tile; ++tile) {
    if (!tile.isValueOn() && tile.getValue() == tree.background()) continue;
    const openvdb::Coord at = tile.getCoord();
    require(
        tree.getValueDepth(at) == int(tile.getDepth()) && tree.isValueOn(at) == tile.isValueOn(),
        at);
  }
}

void fail_as_non_finite(std::uint64_t count, const glm::ivec3& first,
                        const glm::dmat4& world_from_index, const std::string& label) {
  const glm::dvec4 world = world_from_index * glm::dvec4(first, 1.0);
  throw Error(fmt::format(
      "{}: {} {} NaN, infinite or too large for float; the first is voxel ({}, {}, {}), at "
      "({:g}, {:g}, {:g})",
      label, count, count == 1 ? "voxel is" : "voxels are", first.x, first.y, first.z, world.x,
      world.y, world.z));
}

template <class Tree>
void require_finite(const Tree& tree, const glm::dmat4& world_from_index,
                    const std::string& label) {
  std::uint64_t count = 0;
  openvdb::Coord first = openvdb::Coord::max();
  const auto report = [&](const openvdb::Coord& at, std::uint64_t voxels) {
    count += voxels;
    if (std::tuple(at.z(), at.y(), at.x()) < std::tuple(first.z(), first.y(), first.x()))
      first = at;
  };
  if (!is_finite(tree.background()))
    throw Error(fmt::format("{}: the background value is NaN or infinite", label));
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    const auto* values = leaf->buffer().data();
    for (openvdb::Index i = 0; i < leaf->size(); ++i)
      if (!is_finite(values[i])) report(leaf->offsetToGlobalCoord(i), 1);
  }
  for (auto tile = tiles_of(tree); tile; ++tile)
    if (!is_finite(tile.getValue())) report(tile.getCoord(), tile.getVoxelCount());
  if (count > 0)
    fail_as_non_finite(count, {first.x(), first.y(), first.z()}, world_from_index, label);
}

template <class Tree>
void clean(Tree& tree, const std::string& label, Notices& notices) {
  std::uint64_t negative = 0;
  const auto background = without_negatives(tree.background());
  tree.root().setBackground(background, /*updateChildNodes=*/true);
  for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
    auto* values = leaf->buffer().data();
    for (openvdb::Index i = 0; i < leaf->size(); ++i) {
      if (is_negative(values[i])) {
        ++negative;
        values[i] = without_negatives(values[i]);
      }
      if (values[i] != background) leaf->setValueOn(i);
    }
  }
  for (auto tile = tiles_of(tree); tile; ++tile) {
    if (is_negative(tile.getValue())) {
      negative += tile.getVoxelCount();
      tile.setValue(without_negatives(tile.getValue()));
    }
    if (tile.getValue() != background) tile.setActiveState(true);
  }
  if (negative > 0)
    notices.warn(fmt::format("{}: {} negative {} set to 0", label, negative,
                             negative == 1 ? "voxel was" : "voxels were"));
}

template <class Tree>
bool is_zero(const Tree& tree) {
  const auto zero = openvdb::zeroVal<typename Tree::ValueType>();
  for (auto value = tree.cbeginValueOn(); value; ++value)
    if (value.getValue() != zero) return false;
  return true;
}

template void require_sound_tree(const openvdb::FloatTree&, const std::string&);
template void require_sound_tree(const openvdb::DoubleTree&, const std::string&);
template void require_sound_tree(const openvdb::Vec3STree&, const std::string&);
template void require_sound_tree(const openvdb::Vec3DTree&, const std::string&);
template void require_finite(const openvdb::FloatTree&, const glm::dmat4&, const std::string&);
template void require_finite(const openvdb::Vec3STree&, const glm::dmat4&, const std::string&);
template bool is_zero(const openvdb::FloatTree&);
template bool is_zero(const openvdb::Vec3STree&);
template void clean(openvdb::FloatTree&, const std::string&, Notices&);
template void clean(openvdb::Vec3STree&, const std::string&, Notices&);

}  // namespace brume
