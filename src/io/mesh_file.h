// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "geometry/mesh_data.h"

namespace brume {

/// Reads a Wavefront OBJ: v, vt, vn and f; everything else is skipped. Polygons become fans of
/// triangles; normals and uvs count only if every corner has one. Throws an Error
/// `path:line: ...` for what is malformed or without any face.
MeshData read_obj(const std::filesystem::path& path);

/// Reads a PLY (ascii or binary of either byte order): vertices x y z, nx ny nz, u v (or s t) and
/// faces vertex_index or vertex_indices, polygons as fans; everything else is skipped. Throws an
/// Error that names the path, and the line where there are lines.
MeshData read_ply(const std::filesystem::path& path);

}  // namespace brume
