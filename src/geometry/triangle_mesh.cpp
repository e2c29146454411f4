// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangle_mesh.h"

#include <cassert>

#include "core/frame.h"
#include "core/warp.h"
#include "geometry/area_sampling.h"

namespace brume {
namespace {

void turn_inside_out(std::vector<std::uint32_t>& indices) {
  for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
}

void to_world_space(MeshData& mesh, const glm::dmat4& to_world) {
  for (Vec3& p : mesh.positions) p = Vec3(to_world * glm::dvec4(Vec3d(p), 1.0));
  const Mat3d linear(to_world);
  const double determinant = glm::determinant(linear);
  if (determinant < 0.0) turn_inside_out(mesh.indices);
  if (mesh.normals.empty()) return;
  assert(determinant != 0.0);
  const Mat3d normals_to_world = glm::transpose(glm::inverse(linear));
  for (Vec3& n : mesh.normals) {
    const Vec3d world = normals_to_world * Vec3d(n);
    const double length = glm::length(world);
    n = length > 0.0 ? Vec3(world / length) : Vec3(0.0f);
  }
}

/// How far the vertex normals agree with the order of the corners, weighted by area.
double agreement_of_normals(const MeshData& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t corner) {
      return Vec3d(mesh.positions[mesh.indices[i + corner]]);
    };
    const Vec3d cross = glm::cross(p(1) - p(0), p(2) - p(0));
    for (std::size_t corner = 0; corner < 3; ++corner)
      sum += glm::dot(cross, Vec3d(mesh.normals[mesh.indices[i + corner]]));
  }
  return sum;
}

/// Nearest weights of a point at least `margin` [unit] away from all edges; the center of the
/// inscribed circle in a triangle that is too narrow for that.
Vec3d away_from_edges(const Vec3d& weights, const std::array<double, 3>& edge_lengths,
                      double twice_area, double margin) {
  // A weight is the distance from the opposite edge over the height.
  Vec3d least(0.0);
  for (int i = 0; i < 3; ++i) least[i] = margin * edge_lengths[i] / twice_area;
  const double sum = least.x + least.y + least.z;
  if (!(sum < 1.0)) return least / sum;
  const Vec3d excess = glm::max(weights - least, 0.0);
  return least + (1.0 - sum) / (excess.x + excess.y + excess.z) * excess;
}

}  // namespace

TriangleMesh::TriangleMesh(MeshData data, const glm::dmat4& to_world, bool face_normals,
                           bool flip_normals)
    : data_(std::move(data)), flip_normals_(flip_normals) {
  assert(!data_.indices.empty() && data_.indices.size() % 3 == 0);
  assert(data_.normals.empty() || data_.normals.size() == data_.positions.size());
  assert(data_.uvs.empty() || data_.uvs.size() == data_.positions.size());

  if (face_normals) data_.normals = {};
  const bool has_normals = !data_.normals.empty();
  to_world_space(data_, to_world);
  if (has_normals && agreement_of_normals(data_) < 0.0) turn_inside_out(data_.indices);
  if (!has_normals && !face_normals) data_.normals = smooth_normals(data_);

  for (std::uint32_t i = 0; i < triangle_count(); ++i) {
    bounds_.extend(triangles_.bounds(i));
    area_ += 0.5 * glm::length(corners(i).cross());
  }
  hierarchy_.emplace(triangles_, Hierarchy::Behind::kIgnore);
}

TriangleMesh::Corners TriangleMesh::corners(std::uint32_t triangle) const {
  const std::uint32_t* index = &data_.indices[3 * std::size_t(triangle)];
  return {{Vec3d(data_.positions[index[0]]), Vec3d(data_.positions[index[1]]),
           Vec3d(data_.positions[index[2]])}};
}

std::array<double, 3> TriangleMesh::Corners::edge_lengths() const {
  return {glm::length(p[2] - p[1]), glm::length(p[0] - p[2]), glm::length(p[1] - p[0])};
}

Box3 TriangleMesh::Triangles::bounds(std::uint32_t triangle) const {
  Box3 box;
  for (std::size_t corner = 0; corner < 3; ++corner)
    box.extend(mesh_.data_.positions[mesh_.data_.indices[3 * std::size_t(triangle) + corner]]);
  return box;
}

std::optional<Crossing> TriangleMesh::Triangles::intersect(std::uint32_t triangle,
                                                           const PreciseRay& ray,
                                                           double t_max) const {
  const Corners c = mesh_.corners(triangle);
  // Volumes of the ray direction with the edges, each the weight of the opposite corner but for a
  // common factor (Woop et al. 2013). Two triangles compute exactly opposite values for a shared
  // edge, so that a ray through it meets at least one of them.
  const Vec3d p0 = c.p[0] - ray.o, p1 = c.p[1] - ray.o, p2 = c.p[2] - ray.o;
  const double v0 = glm::dot(ray.d, glm::cross(p1, p2));
  const double v1 = glm::dot(ray.d, glm::cross(p2, p0));
  const double v2 = glm::dot(ray.d, glm::cross(p0, p1));
  if (std::min({v0, v1, v2}) < 0.0 && std::max({v0, v1, v2}) > 0.0) return std::nullopt;

  // From the plane rather than from the weights: then the sign tells the side of the plane that
  // the origin is on.
  const Vec3d cross = c.cross();
  const double t = glm::dot(cross, p0) / glm::dot(cross, ray.d);
  if (!(t > 0.0 && t <= t_max)) return std::nullopt;

  const double sum = v0 + v1 + v2;
  if (sum == 0.0) return std::nullopt;  // edge on
  return Crossing{.t = t, .face = triangle, .xy = {v1 / sum, v2 / sum}};
}

std::optional<Crossing> TriangleMesh::intersect(const PreciseRay& ray, double t_max) const {
  const auto found = hierarchy_->nearest(ray, t_max);
  if (!found) return std::nullopt;
  Crossing crossing = found->crossings.nearest().crossing;
  crossing.t += found->start;
  return crossing;
}

bool TriangleMesh::occludes(const PreciseRay& ray, double t_max) const {
  return hierarchy_->obstacle(ray, t_max) != Obstacle::kNone;
}

Hit TriangleMesh::hit(const PreciseRay& /*ray*/, const Crossing& crossing) const {
  const std::uint32_t triangle = crossing.face;
  const Corners c = corners(triangle);
  const Vec3d weights(1.0 - crossing.xy.x - crossing.xy.y, crossing.xy);
  const Vec3d cross = c.cross();
  const Vec3 n = outside(cross);
  const auto point = [&](const Vec3d& b) {
    return Vec3(b.x * c.p[0] + b.y * c.p[1] + b.z * c.p[2]);
  };
  const std::array<double, 3> edges = c.edge_lengths();
  const float error = surface_error(point(weights), n, std::max({edges[0], edges[1], edges[2]}));
  const Vec3d inner = away_from_edges(weights, edges, glm::length(cross), kEdgeMargin * error);
  return {.t = 0.0f,
          .p = point(inner),
          .error = error,
          .n = n,
          .n_shading = shading_normal(triangle, weights, n),
          .dp_du = dp_du(triangle, c, n),
          .uv = uv(triangle, weights),
          .shape = 0};
}

Vec3 TriangleMesh::shading_normal(std::uint32_t triangle, const Vec3d& weights,
                                  const Vec3& n) const {
  if (data_.normals.empty()) return n;
  const std::uint32_t* index = &data_.indices[3 * std::size_t(triangle)];
  Vec3d sum(0.0);
  for (int i = 0; i < 3; ++i) sum += weights[i] * Vec3d(data_.normals[index[i]]);
  const double length = glm::length(sum);
  if (!(length > 0.0)) return n;
  const Vec3 smooth(sum / length);
  return glm::dot(smooth, n) < 0.0f ? -smooth : smooth;
}

Vec3 TriangleMesh::dp_du(std::uint32_t triangle, const Corners& c, const Vec3& n) const {
  if (!data_.uvs.empty()) {
    const std::uint32_t* index = &data_.indices[3 * std::size_t(triangle)];
    const Vec2d uv0(data_.uvs[index[0]]);
    const Vec2d duv1 = Vec2d(data_.uvs[index[1]]) - uv0, duv2 = Vec2d(data_.uvs[index[2]]) - uv0;
    const double determinant = duv1.x * duv2.y - duv1.y * duv2.x;
    if (determinant != 0.0)
      return Vec3((duv2.y * (c.p[1] - c.p[0]) - duv1.y * (c.p[2] - c.p[0])) / determinant);
  }
  return Frame(n).s;
}

Vec2 TriangleMesh::uv(std::uint32_t triangle, const Vec3d& weights) const {
  if (data_.uvs.empty()) return Vec2(weights.y, weights.z);
  const std::uint32_t* index = &data_.indices[3 * std::size_t(triangle)];
  Vec2d sum(0.0);
  for (int i = 0; i < 3; ++i) sum += weights[i] * Vec2d(data_.uvs[index[i]]);
  return Vec2(sum);
}

const Distribution1d& TriangleMesh::triangles_by_area() const {
  std::call_once(triangles_by_area_once_, [this] {
    std::vector<float> weights(triangle_count());
    for (std::uint32_t i = 0; i < triangle_count(); ++i)
      weights[i] = static_cast<float>(0.5 * glm::length(corners(i).cross()) / area_);
    triangles_by_area_ = std::make_unique<const Distribution1d>(weights);
  });
  return *triangles_by_area_;
}

SurfacePoint TriangleMesh::sample_area(const Vec2& u) const {
  const Distribution1d& distribution = triangles_by_area();
  const Distribution1d::Sample chosen = distribution.sample(u.x);
  const Corners c = corners(static_cast<std::uint32_t>(chosen.index));
  const Vec2d b(sample_triangle({chosen.offset, u.y}));
  const Vec3 p((1.0 - b.x - b.y) * c.p[0] + b.x * c.p[1] + b.y * c.p[2]);
  const std::array<double, 3> edges = c.edge_lengths();
  const Vec3 n = outside(c.cross());
  return {.p = p, .n = n, .error = surface_error(p, n, std::max({edges[0], edges[1], edges[2]}))};
}

std::optional<ShapeSample> TriangleMesh::sample_toward(const Vec3& from, const Vec2& u) const {
  return sample_by_area(from, sample_area(u), area_);
}

float TriangleMesh::pdf_toward(const Vec3& from, const Hit& hit) const {
  return solid_angle_pdf(from, hit.p, hit.n, area_);
}

}  // namespace brume
