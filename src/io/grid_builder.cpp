// SPDX-License-Identifier: Apache-2.0
#include "io/grid_builder.h"

#include <fmt/format.h>
#include <malloc.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Prune.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "io/grid_checks.h"
#include "io/grid_from_vol.h"
#include "io/grid_to_nano.h"

namespace brume {
namespace {

template <class Value>
struct OpenType;
template <>
struct OpenType<float> {
  using Grid = openvdb::FloatGrid;
  using DoubleGrid = openvdb::DoubleGrid;
};
template <>
struct OpenType<Rgb> {
  using Grid = openvdb::Vec3SGrid;
  using DoubleGrid = openvdb::Vec3DGrid;
};

glm::dmat4 to_glm(const openvdb::Mat4d& m) {
  glm::dmat4 result(1);
  for (int row = 0; row < 4; ++row)  // OpenVDB multiplies row vectors, GLM columns
    for (int column = 0; column < 4; ++column) result[row][column] = m(row, column);
  return result;
}

void require_invertible(const glm::dmat4& m, const std::string& label) {
  const glm::dmat3 linear(m);
  const double volume = std::abs(glm::determinant(linear));
  const double edges = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  constexpr double kFlat = 1e-12;
  if (volume > kFlat * edges && std::isfinite(edges) && std::isfinite(glm::length(m[3]))) return;
  throw Error(fmt::format("{}: its transform to the world is singular or not finite", label));
}

template <class Value>
std::shared_ptr<const Grid<Value>> finish(typename OpenType<Value>::Grid& grid,
                                          const glm::dmat4& world_from_index, const Box3& box,
                                          Interpolation interpolation, Wrap wrap) {
  return std::make_shared<const Grid<Value>>(grid_to_nano(grid.tree()), world_from_index, box,
                                             interpolation, wrap);
}

template <class Value>
std::shared_ptr<const Grid<Value>> vacuum(const glm::dmat4& world_from_index,
                                          Interpolation interpolation) {
  typename OpenType<Value>::Grid empty(
      openvdb::zeroVal<typename OpenType<Value>::Grid::ValueType>());
  return finish<Value>(empty, world_from_index, {Vec3(-0.5f), Vec3(0.5f)}, interpolation,
                       Wrap::kBackground);
}

/// Narrow-band distances become a fog of density 1 inside, falling to 0 at the surface. The value
/// outside is the width of the band; where a program wrote 0 there, the largest distance is.
void turn_into_fog(openvdb::FloatGrid& grid, const std::string& label, Notices& notices) {
  float lowest = 0.0f, highest = 0.0f;
  for (auto value = grid.cbeginValueAll(); value; ++value) {
    lowest = std::min(lowest, *value);
    highest = std::max(highest, *value);
  }
  if (lowest == 0.0f)
    notices.warn(fmt::format("{}: a level set without an inside: no distance is negative", label));
  if (grid.background() <= 0.0f && lowest < 0.0f) {
    const float width = std::max(-lowest, highest);
    notices.warn(fmt::format(
        "{}: a level set whose value outside is {:g}, where the width of its band belongs; took "
        "the largest distance in it, {:.4g}",
        label, grid.background(), width));
    openvdb::tools::changeBackground(grid.tree(), width);
  }
  openvdb::tools::sdfToFogVolume(grid);
  notices.warn(fmt::format(
      "{}: a level set, turned into fog: density 1 inside, falling to 0 at the surface", label));
}
void turn_into_fog(openvdb::Vec3SGrid&, const std::string&, Notices&) {}

/// Moves a tree of doubles into an empty one of floats. Its leaves are deleted one by one, so that
/// both trees are never whole at the same time.
template <class WideTree, class NarrowTree>
void narrow(WideTree& wide, NarrowTree& result) {
  using Value = typename NarrowTree::ValueType;
  using NarrowLeaf = typename NarrowTree::LeafNodeType;
  using WideLeaf = typename WideTree::LeafNodeType;
  std::vector<WideLeaf*> leaves;
  wide.stealNodes(leaves);
  for (WideLeaf*& wide_leaf : leaves) {
    const std::unique_ptr<const WideLeaf> leaf(wide_leaf);
    auto narrow_leaf = std::make_unique<NarrowLeaf>(leaf->origin(), openvdb::zeroVal<Value>());
    Value* values = narrow_leaf->buffer().data();
    for (openvdb::Index i = 0; i < NarrowLeaf::SIZE; ++i)
      values[i] = Value(leaf->buffer().data()[i]);
    narrow_leaf->setValueMask(leaf->getValueMask());
    result.addLeaf(narrow_leaf.release());
  }
  for (auto tile = wide.cbeginValueAll(); tile; ++tile)
    if (tile.isValueOn() || *tile != wide.background())
      result.sparseFill(tile.getBoundingBox(), Value(*tile), tile.isValueOn());
  malloc_trim(0);  // an allocator of small blocks does not return them on its own
}

/// The same grid in single precision. Uses up `source`.
template <class Value>
typename OpenType<Value>::Grid::Ptr in_float(const openvdb::GridBase::Ptr& source,
                                             const std::string& label) {
  using FloatGrid = typename OpenType<Value>::Grid;
  using DoubleGrid = typename OpenType<Value>::DoubleGrid;
  if (const auto same = openvdb::gridPtrCast<FloatGrid>(source)) {
    require_sound_tree(same->tree(), label);
    return same;
  }
  const auto wide = openvdb::gridPtrCast<DoubleGrid>(source);
  require_sound_tree(wide->tree(), label);
  const auto result = FloatGrid::create(typename FloatGrid::ValueType(wide->background()));
  result->setGridClass(wide->getGridClass());
  narrow(wide->tree(), result->tree());
  return result;
}

/// World placement of a dense volume with voxel centres at integers: Mitsuba's unit cube or box.
glm::dmat4 placement(const VolHeader& vol, const VolumeRequest& request) {
  const glm::dvec3 lo = request.use_grid_bbox ? vol.box_min : glm::dvec3(0.0);
  const glm::dvec3 hi = request.use_grid_bbox ? vol.box_max : glm::dvec3(1.0);
  glm::dmat4 m = glm::translate(request.to_world, lo);
  m = glm::scale(m, (hi - lo) / glm::dvec3(vol.resolution));
  return glm::translate(m, glm::dvec3(0.5));
}

}  // namespace

template <class Value>
std::shared_ptr<const Grid<Value>> build_grid(openvdb::GridBase::Ptr source,
                                              const std::string& label,
                                              const VolumeRequest& request, Notices& notices) {
  if (!source->transform().isLinear())
    throw Error(fmt::format("{}: its transform \"{}\" is not affine; resample the grid first",
                            label, source->transform().mapType()));
  const glm::dmat4 world_from_index =
      request.to_world * to_glm(source->transform().baseMap()->getAffineMap()->getMat4());
  require_invertible(world_from_index, label);

  const auto grid = in_float<Value>(source, label);
  source.reset();
  require_finite(grid->tree(), world_from_index, label);
  if (grid->getGridClass() == openvdb::GRID_LEVEL_SET) turn_into_fog(*grid, label, notices);
  auto& tree = grid->tree();
  clean(tree, label, notices);

  openvdb::CoordBBox active;
  if (!tree.evalActiveVoxelBoundingBox(active)) {
    notices.warn(fmt::format("{}: empty, rendered as vacuum", label));
    return vacuum<Value>(world_from_index, request.interpolation);
  }
  openvdb::tools::prune(tree);
  const auto zero = openvdb::zeroVal<typename OpenType<Value>::Grid::ValueType>();
  const bool zero_background = tree.background() == zero;
  if (!zero_background)
    notices.warn(fmt::format(
        "{}: the value outside its voxels is not 0; the volume ends with its voxels", label));
  if (is_zero(tree)) notices.warn(fmt::format("{}: every voxel is 0, rendered as vacuum", label));

  // Trilinear interpolation of the outermost voxels falls to the background within one voxel.
  const bool fades = request.interpolation == Interpolation::kTrilinear && zero_background;
  const float reach = fades ? 1.0f : 0.5f;
  const Box3 box{Vec3(active.min().x(), active.min().y(), active.min().z()) - reach,
                 Vec3(active.max().x(), active.max().y(), active.max().z()) + reach};
  return finish<Value>(*grid, world_from_index, box, request.interpolation, Wrap::kBackground);
}

template <class Value>
std::shared_ptr<const Grid<Value>> build_grid(const VolHeader& vol, const NextLayers& next_layers,
                                              const VolumeRequest& request, Notices& notices) {
  using OpenGrid = typename OpenType<Value>::Grid;
  const glm::ivec3 n = vol.resolution;
  const glm::dmat4 world_from_index = placement(vol, request);
  require_invertible(world_from_index, request.path);

  OpenGrid grid(openvdb::zeroVal<typename OpenGrid::ValueType>());
  fill_from_vol(grid, vol, next_layers, world_from_index, request.path);
  clean(grid.tree(), request.path, notices);
  if (request.wrap != Wrap::kBackground) add_wrapped_layer(grid, n, request.wrap);
  if (is_zero(grid.tree()))
    notices.warn(fmt::format("{}: every voxel is 0, rendered as vacuum", request.path));
  const Box3 box{Vec3(-0.5f), Vec3(n) - 0.5f};
  return finish<Value>(grid, world_from_index, box, request.interpolation, request.wrap);
}

template std::shared_ptr<const Grid<float>> build_grid(openvdb::GridBase::Ptr, const std::string&,
                                                       const VolumeRequest&, Notices&);
template std::shared_ptr<const Grid<Rgb>> build_grid(openvdb::GridBase::Ptr, const std::string&,
                                                     const VolumeRequest&, Notices&);
template std::shared_ptr<const Grid<float>> build_grid(const VolHeader&, const NextLayers&,
                                                       const VolumeRequest&, Notices&);
template std::shared_ptr<const Grid<Rgb>> build_grid(const VolHeader&, const NextLayers&,
                                                     const VolumeRequest&, Notices&);

}  // namespace brume
