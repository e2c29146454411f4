// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/notices.h"
#include "volume/grid.h"

namespace brume {

/// One grid of a volume file as the file itself describes it.
struct GridSummary {
  struct Extent {
    std::uint64_t active_voxels = 0;  // those inside active tiles included
    glm::ivec3 min{0}, max{-1};       // [voxels], of the active ones, both inside; min > max: none
    std::uint64_t memory_bytes = 0;   // of the voxel data in memory
  };

  std::string name = {};  // as stored; may be empty, or shared by several grids
  /// Chooses this grid: "density", or "density[1]" of several, or "[0]" without a name.
  std::string selector = {};
  std::string value_type = {};        // in words: "float", "half float", "vec3 float", "int32", ...
  std::string grid_class = {};        // in words: "fog volume", "level set", ..., "no class"
  int channels = 0;                   // 1 or 3 where brume can render it, 0 where it cannot
  std::optional<Extent> extent = {};  // empty for a type that cannot be read
  std::optional<glm::dvec3> voxel_size = {};  // [file units]; empty for a type that cannot be read
};

/// What a .vdb, .nvdb or .vol file holds, in the order of the file. Reads headers only, except for
/// files that do not record the extent of their grids. Throws an Error when it is none of these.
std::vector<GridSummary> list_grids(const std::string& path);

/// One line about a grid: `density[1]: float, fog volume, 2222 active voxels, ...`.
std::string describe(const GridSummary& grid);

/// Which grid of which file, and how it is placed and read.
struct VolumeRequest {
  std::string path;
  /// A `GridSummary::selector` or name; empty takes "density", or else the only grid that fits.
  std::string grid = {};
  Interpolation interpolation = Interpolation::kTrilinear;
  Wrap wrap = Wrap::kClamp;             // outside the box of a .vol; sparse files have a background
  bool use_grid_bbox = false;           // a .vol fills the box in its header, not [0, 1]^3
  glm::dmat4 to_world = glm::dmat4(1);  // applied after the transform of the file
};

/// Densities of a .vdb, .nvdb or one-channel .vol, ready to render: finite, not negative (negative
/// values become 0 with a notice), a level set turned into fog. An empty grid is vacuum. Throws an
/// Error that says what the file holds when there is no such grid.
std::shared_ptr<const Grid<float>> load_scalar_grid(const VolumeRequest& request, Notices& notices);

/// As `load_scalar_grid`, or vectors of three floats or a three-channel .vol; without a name a
/// scalar grid comes first.
using AnyGrid = std::variant<std::shared_ptr<const Grid<float>>, std::shared_ptr<const Grid<Rgb>>>;
AnyGrid load_grid(const VolumeRequest& request, Notices& notices);

}  // namespace brume
