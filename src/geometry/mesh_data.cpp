// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_data.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "geometry/precise.h"

namespace brume {
namespace {

bool precedes(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// For each vertex, a number that vertices at the same position share.
std::vector<std::uint32_t> welded(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return precedes(positions[a], positions[b]); });
  std::vector<std::uint32_t> result(positions.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && precedes(positions[order[i - 1]], positions[order[i]])) ++number;
    result[order[i]] = number;
  }
  return result;
}

}  // namespace

std::vector<Vec3> smooth_normals(const MeshData& mesh) {
  std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0.0));
  for (std::size_t first = 0; first < mesh.indices.size(); first += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.indices[first + corner];
      const Vec3d p(mesh.positions[vertex]);
      const Vec3d a = Vec3d(mesh.positions[mesh.indices[first + (corner + 1) % 3]]) - p;
      const Vec3d b = Vec3d(mesh.positions[mesh.indices[first + (corner + 2) % 3]]) - p;
      const Vec3d cross = glm::cross(a, b);
      const double length = glm::length(cross);
      if (length > 0.0) sums[vertex] += std::atan2(length, glm::dot(a, b)) / length * cross;
    }
  }

  std::vector<Vec3> normals;
  normals.reserve(sums.size());
  for (const Vec3d& sum : sums) {
    const double length = glm::length(sum);
    normals.push_back(length > 0.0 ? Vec3(sum / length) : Vec3(0.0f));
  }
  return normals;
}

bool is_closed_surface(const MeshData& mesh) {
  const std::vector<std::uint32_t> vertex = welded(mesh.positions);
  struct Edge {
    std::uint32_t low, high;
    int side;  // +1 for a triangle that runs from low to high, else -1
  };
  std::vector<Edge> edges;
  edges.reserve(mesh.indices.size());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const std::uint32_t a = vertex[mesh.indices[i]], b = vertex[mesh.indices[next]];
    if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
  }
  if (edges.empty()) return false;

  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high) < std::tie(b.low, b.high);
  });
  for (std::size_t i = 0; i < edges.size();) {
    const Edge edge = edges[i];
    int balance = 0;
    for (; i < edges.size() && edges[i].low == edge.low && edges[i].high == edge.high; ++i)
      balance += edges[i].side;
    if (balance != 0) return false;
  }
  return true;
}

}  // namespace brume
