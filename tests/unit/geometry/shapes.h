// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/ext/matrix_transform.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/warp.h"
#include "geometry/cube.h"
#include "geometry/cylinder.h"
#include "geometry/disk.h"
#include "geometry/ray_queries.h"
#include "geometry/rectangle.h"
#include "geometry/sphere.h"
#include "geometry/triangle_mesh.h"

namespace brume::test {

using ShapePtr = std::shared_ptr<const Shape>;

inline RayQueries queries(const ShapePtr& shape) {
  return RayQueries(std::vector<ShapePtr>{shape});
}

/// Whether anything lies along `ray` in (0, t_max).
inline bool is_occluded(const RayQueries& queries, const Ray& ray, float t_max) {
  return queries.obstacle(ray, t_max) != Obstacle::kNone;
}

/// Sphere of triangles around the origin with corners on the unit sphere; every round of
/// subdivision makes four triangles of one.
inline MeshData sphere_mesh(int rounds) {
  MeshData mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  for (int round = 0; round < rounds; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), mesh.positions.size());
      if (is_new) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.indices = std::move(finer);
  }
  return mesh;
}

/// Uniform scale, then an odd rotation, then a translation.
inline glm::dmat4 placed(double scale, const glm::dvec3& offset) {
  const glm::dmat4 rotation =
      glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
  return glm::translate(glm::dmat4(1.0), offset) * rotation *
         glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
}

/// A sheared and unevenly scaled transform of about unit size.
inline glm::dmat4 skewed() {
  return glm::dmat4(glm::dvec4(1.0, 0.2, 0.0, 0.0), glm::dvec4(-0.3, 0.8, 0.1, 0.0),
                    glm::dvec4(0.4, 0.0, 0.6, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
}

inline glm::dmat4 mirrored() {
  return glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
}

}  // namespace brume::test
