// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <mutex>

#include "core/distribution.h"
#include "geometry/mesh_data.h"
#include "geometry/shape.h"

namespace brume {

/// Triangles under any affine transform. Neighbours that share vertex positions leave no gap for a
/// ray, and no ray finds the triangle again that it has just left.
///
/// The order of the corners tells the outside, unless the vertex normals of the file disagree for
/// most of the surface, which then decide for the whole mesh. uv are those of the file, or
/// barycentric coordinates (b1, b2) of each triangle.
class TriangleMesh final : public Shape {
 public:
  /// `indices` must be valid and at least one triangle. Without normals, smooth ones are made, as
  /// Mitsuba 3 does; `face_normals` leaves out both kinds.
  TriangleMesh(MeshData data, const glm::dmat4& to_world, bool face_normals, bool flip_normals);

  Box3 bounds() const override { return bounds_; }
  float area() const override { return static_cast<float>(area_); }
  /// Looks through all edges each time.
  bool is_closed() const override { return is_closed_surface(data_); }
  SurfacePoint sample_area(const Vec2& u) const override;
  std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const override;
  float pdf_toward(const Vec3& from, const Hit& hit) const override;

  std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const override;
  bool occludes(const PreciseRay& ray, double t_max) const override;
  Hit hit(const PreciseRay& ray, const Crossing& crossing) const override;

 private:
  /// The triangles, for the hierarchy.
  class Triangles final : public Hierarchy::Items {
   public:
    explicit Triangles(const TriangleMesh& mesh) : mesh_(mesh) {}
    std::uint32_t count() const override { return mesh_.triangle_count(); }
    Box3 bounds(std::uint32_t triangle) const override;
    std::optional<Crossing> intersect(std::uint32_t triangle, const PreciseRay& ray,
                                      double t_max) const override;
    Obstacle obstacle(std::uint32_t triangle, const PreciseRay& ray, double t_max) const override {
      return intersect(triangle, ray, t_max) ? Obstacle::kOpaque : Obstacle::kNone;
    }

   private:
    const TriangleMesh& mesh_;
  };

  /// Corners of a triangle in double, exact.
  struct Corners {
    std::array<Vec3d, 3> p;  // [unit]

    Vec3d cross() const { return glm::cross(p[1] - p[0], p[2] - p[0]); }  // twice the area [unit^2]
    std::array<double, 3> edge_lengths() const;  // each opposite to its corner [unit]
  };
  Corners corners(std::uint32_t triangle) const;
  std::uint32_t triangle_count() const {
    return static_cast<std::uint32_t>(data_.indices.size() / 3);
  }

  Vec3 outside(const Vec3d& cross) const {
    return Vec3(glm::normalize(cross)) * (flip_normals_ ? -1.0f : 1.0f);
  }
  Vec3 shading_normal(std::uint32_t triangle, const Vec3d& weights, const Vec3& n) const;
  /// Tangent along u [unit], or any tangent where the uv do not tell.
  Vec3 dp_du(std::uint32_t triangle, const Corners& c, const Vec3& n) const;
  Vec2 uv(std::uint32_t triangle, const Vec3d& weights) const;
  const Distribution1d& triangles_by_area() const;

  MeshData data_;  // in the world
  bool flip_normals_;
  Box3 bounds_;
  double area_ = 0.0;  // [unit^2]
  Triangles triangles_{*this};
  std::optional<Hierarchy> hierarchy_;  // set on construction, when the triangles are in place

  // Only meshes that emit need it.
  mutable std::once_flag triangles_by_area_once_;
  mutable std::unique_ptr<const Distribution1d> triangles_by_area_;
};

}  // namespace brume
