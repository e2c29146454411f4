// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/vec.h"

namespace brume {

/// Triangles as a file holds them, polygons cut into fans.
struct MeshFile {
  std::vector<Vec3> positions;         // [file unit]
  std::vector<Vec3> normals;           // one a position, any length; empty if the file has none
  std::vector<Vec2> uvs;               // one a position; empty if the file has none
  std::vector<std::uint32_t> indices;  // three a triangle, at least one triangle
};

/// Reads a Wavefront OBJ: v, vt, vn and f; everything else is skipped. Normals and uvs count only
/// if every corner has one. Throws an Error `path:line: ...` for what is malformed.
MeshFile read_obj(const std::filesystem::path& path);

/// Reads a PLY (ascii or binary of either byte order): vertices x y z, nx ny nz, u v (or s t) and
/// faces vertex_index or vertex_indices; everything else is skipped. Throws an Error that names
/// the path, and the line where there are lines.
MeshFile read_ply(const std::filesystem::path& path);

}  // namespace brume
