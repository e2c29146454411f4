// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace brume {

/// Triangles as files hold them. Seen from outside, the corners of a triangle run counterclockwise.
struct MeshData {
  std::vector<Vec3> positions;         // [unit]
  std::vector<std::uint32_t> indices;  // into the vertices, three a triangle
  std::vector<Vec3> normals;           // one a vertex, of any length, or none at all
  std::vector<Vec2> uvs;               // one a vertex, or none at all
};

/// Unit normals of the vertices: mean of the triangles around, weighted by their angle at the
/// vertex (Thürmer and Wüthrich 1998). Zero where all triangles are degenerate.
std::vector<Vec3> smooth_normals(const MeshData& mesh);

/// Whether each edge is shared by as many triangles on its one side as on its other. Vertices at
/// equal positions are the same vertex here, as files split them along seams of normals and uv.
bool is_closed_surface(const MeshData& mesh);

}  // namespace brume
