// SPDX-License-Identifier: Apache-2.0
#include "geometry/cube.h"

#include <cassert>
#include <glm/gtc/matrix_access.hpp>

#include "geometry/area_sampling.h"

namespace brume {
namespace {

/// Local axis and direction in which a surface parameter grows.
struct UvAxis {
  int axis;
  double sign;
};
struct UvAxes {
  UvAxis u, v;
};
constexpr std::array<UvAxes, 6> kUvAxes{{
    {{1, 1.0}, {2, 1.0}},    // -X
    {{1, 1.0}, {2, -1.0}},   // +X
    {{2, 1.0}, {0, 1.0}},    // -Y
    {{0, -1.0}, {2, -1.0}},  // +Y
    {{1, -1.0}, {0, 1.0}},   // -Z
    {{1, 1.0}, {0, 1.0}},    // +Z
}};

int axis_of(int side) {
  return side / 2;
}
double sign_of(int side) {
  return side % 2 == 0 ? -1.0 : 1.0;
}

}  // namespace

Cube::Cube(const glm::dmat4& to_world, bool flip_normals)
    : center_(to_world[3]), to_world_(to_world), to_local_(glm::inverse(to_world_)), extent_(0.0) {
  assert(glm::determinant(to_world_) != 0.0);
  for (int side = 0; side < kSides; ++side) {
    const int axis = axis_of(side);
    const Vec3d &a = to_world_[(axis + 1) % 3], &b = to_world_[(axis + 2) % 3];
    // A gradient points outward under mirrored transforms, too.
    const Vec3d gradient = sign_of(side) * glm::row(to_local_, axis);
    sides_[side] = {.n = Vec3(glm::normalize(gradient)) * (flip_normals ? -1.0f : 1.0f),
                    .area = 4.0 * glm::length(glm::cross(a, b))};
    extent_ = std::max({extent_, 2.0 * glm::length(a + b), 2.0 * glm::length(a - b)});
  }
}

Box3 Cube::bounds() const {
  const Vec3d reach = glm::abs(to_world_[0]) + glm::abs(to_world_[1]) + glm::abs(to_world_[2]);
  return rounded_outward(center_ - reach, center_ + reach);
}

float Cube::area() const {
  return static_cast<float>(all_sides().total);
}

std::optional<Crossing> Cube::intersect(const PreciseRay& ray, double t_max) const {
  const Vec3d o = to_local_ * (ray.o - center_), d = to_local_ * ray.d;
  double t_enter = -std::numeric_limits<double>::infinity();
  double t_leave = std::numeric_limits<double>::infinity();
  std::uint32_t side_enter = 0, side_leave = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) {
      if (std::abs(o[axis]) > 1.0) return std::nullopt;
      continue;
    }
    const std::uint32_t positive = d[axis] > 0.0 ? 1 : 0;
    const double toward = d[axis] > 0.0 ? 1.0 : -1.0;
    const double inverse = 1.0 / d[axis];
    const double t0 = (-toward - o[axis]) * inverse, t1 = (toward - o[axis]) * inverse;
    if (t0 > t_enter) {
      t_enter = t0;
      side_enter = 2 * axis + (1 - positive);
    }
    if (t1 < t_leave) {
      t_leave = t1;
      side_leave = 2 * axis + positive;
    }
  }
  if (!(t_enter <= t_leave)) return std::nullopt;
  const bool enters = t_enter > 0.0;
  const double t = enters ? t_enter : t_leave;
  if (!(t > 0.0 && t <= t_max)) return std::nullopt;
  return Crossing{.t = t, .face = enters ? side_enter : side_leave, .xy{}};
}

Hit Cube::hit(const PreciseRay& ray, const Crossing& crossing) const {
  const int side = int(crossing.face), axis = axis_of(side);
  Vec3d local = glm::clamp(to_local_ * (ray.at(crossing.t) - center_), -1.0, 1.0);
  local[axis] = sign_of(side);
  const UvAxes& uv = kUvAxes[side];
  const Vec2 parameters(0.5 + 0.5 * uv.u.sign * local[uv.u.axis],
                        0.5 + 0.5 * uv.v.sign * local[uv.v.axis]);

  const Vec3& n = sides_[side].n;
  const float error = surface_error(Vec3(center_ + to_world_ * local), n, extent_);
  for (int i = 0; i < 3; ++i) {
    if (i == axis) continue;
    const double margin = std::min(kEdgeMargin * error * glm::length(glm::row(to_local_, i)), 1.0);
    local[i] = std::clamp(local[i], margin - 1.0, 1.0 - margin);
  }
  return {.t = 0.0f,
          .p = Vec3(center_ + to_world_ * local),
          .error = error,
          .n = n,
          .n_shading = n,
          .dp_du = Vec3(2.0 * uv.u.sign * to_world_[uv.u.axis]),
          .uv = parameters,
          .shape = 0};
}

template <class Condition>
Cube::SideAreas Cube::sides_where(const Condition& condition) const {
  SideAreas sides;
  for (int side = 0; side < kSides; ++side) {
    if (!condition(side)) continue;
    sides.area[side] = sides_[side].area;
    sides.total += sides_[side].area;
  }
  return sides;
}

Cube::SideAreas Cube::all_sides() const {
  return sides_where([](int /*side*/) { return true; });
}

Cube::SideAreas Cube::sides_seen_from(const Vec3& from) const {
  const Vec3d local = to_local_ * (Vec3d(from) - center_);
  const bool is_inside = std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) <= 1.0;
  if (is_inside) return all_sides();
  return sides_where([&](int side) { return sign_of(side) * local[axis_of(side)] > 1.0; });
}

SurfacePoint Cube::sample_area(const SideAreas& among, const Vec2& u) const {
  // The side by its area; what is left of u.x serves again within the side.
  double rest = u.x * among.total;
  int side = -1;
  for (int i = 0; i < kSides; ++i) {
    if (among.area[i] == 0.0) continue;
    if (side >= 0) {
      if (rest < among.area[side]) break;
      rest -= among.area[side];
    }
    side = i;
  }
  const double u_side = std::min(rest / among.area[side], 1.0);

  const int axis = axis_of(side);
  Vec3d local;
  local[axis] = sign_of(side);
  local[(axis + 1) % 3] = 2.0 * u_side - 1.0;
  local[(axis + 2) % 3] = 2.0 * u.y - 1.0;
  const Vec3 p(center_ + to_world_ * local);
  const Vec3& n = sides_[side].n;
  return {.p = p, .n = n, .error = surface_error(p, n, extent_)};
}

SurfacePoint Cube::sample_area(const Vec2& u) const {
  return sample_area(all_sides(), u);
}

std::optional<ShapeSample> Cube::sample_toward(const Vec3& from, const Vec2& u) const {
  const SideAreas visible = sides_seen_from(from);
  return sample_by_area(from, sample_area(visible, u), visible.total);
}

float Cube::pdf_toward(const Vec3& from, const Hit& hit) const {
  return solid_angle_pdf(from, hit.p, hit.n, sides_seen_from(from).total);
}

}  // namespace brume
