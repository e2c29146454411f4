// SPDX-License-Identifier: Apache-2.0
#include "fluid.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace brume::media {
namespace {

using Vec3f = glm::vec3;

/// The eight values around `p` [voxels of this grid], clamped at the sides.
template <class Value>
struct Corners {
  Value values[8];
  Vec3f f;

  Corners(const DenseGrid<Value>& grid, Vec3f p) {
    p = glm::clamp(p, Vec3f(0.0f), Vec3f(grid.size() - 1));
    const glm::ivec3 lo = glm::min(glm::ivec3(p), grid.size() - 2);
    f = p - Vec3f(lo);
    for (int i = 0; i < 8; ++i)
      values[i] = grid(lo.x + (i & 1), lo.y + (i >> 1 & 1), lo.z + (i >> 2));
  }

  Value interpolated() const {
    const auto along_x = [&](int i) { return glm::mix(values[i], values[i + 1], f.x); };
    return glm::mix(glm::mix(along_x(0), along_x(2), f.y), glm::mix(along_x(4), along_x(6), f.y),
                    f.z);
  }

  Value clamped(const Value& v) const {
    Value lo = values[0], hi = values[0];
    for (int i = 1; i < 8; ++i) {
      lo = glm::min(lo, values[i]);
      hi = glm::max(hi, values[i]);
    }
    return glm::clamp(v, lo, hi);
  }
};

template <class Value>
Value sample(const DenseGrid<Value>& grid, const Vec3f& p) {
  return Corners<Value>(grid, p).interpolated();
}

/// Where the fluid at `p` was `dt` steps ago; `velocity` is given at the centres of cells, and
/// these are the integer points.
Vec3f came_from(const DenseGrid<Vec3f>& velocity, const Vec3f& p, float dt) {
  const Vec3f middle = p - 0.5f * dt * sample(velocity, p);
  return p - dt * sample(velocity, middle);
}

/// `field` moved one step along: there and back shows the error of one way, half of which is then
/// taken off. Its values live at integer points plus `offset`.
template <class Value>
DenseGrid<Value> moved(const DenseGrid<Value>& field, const Vec3f& offset,
                       const DenseGrid<Vec3f>& velocity) {
  DenseGrid<Value> forward(field.size()), result(field.size());
  DenseGrid<Vec3f> from(field.size());
  field.for_each([&](int x, int y, int z) {
    from(x, y, z) = came_from(velocity, Vec3f(x, y, z) + offset, 1.0f) - offset;
    forward(x, y, z) = sample(field, from(x, y, z));
  });
  field.for_each([&](int x, int y, int z) {
    const Vec3f to = came_from(velocity, Vec3f(x, y, z) + offset, -1.0f) - offset;
    const Value corrected = forward(x, y, z) + 0.5f * (field(x, y, z) - sample(forward, to));
    result(x, y, z) = Corners<Value>(field, from(x, y, z)).clamped(corrected);
  });
  return result;
}

}  // namespace

Fluid::Fluid(const glm::ivec3& size)
    : size_(size),
      u_(size + glm::ivec3(1, 0, 0)),
      v_(size + glm::ivec3(0, 1, 0)),
      w_(size + glm::ivec3(0, 0, 1)),
      pressure_(size),
      carried_(size) {}

Vec3f Fluid::center_velocity(int x, int y, int z) const {
  return 0.5f * Vec3f(u_(x, y, z) + u_(x + 1, y, z), v_(x, y, z) + v_(x, y + 1, z),
                      w_(x, y, z) + w_(x, y, z + 1));
}

void Fluid::add_buoyancy(float acceleration, float smoke_weight) {
  v_.for_each([&](int x, int y, int z) {
    if (y == 0 || y == size_.y) return;
    const Vec3f c = 0.5f * (carried_(x, y - 1, z) + carried_(x, y, z));
    v_(x, y, z) += acceleration * (c.z - smoke_weight * (c.x + c.y));
  });
}

void Fluid::add_whirls(float strength) {
  DenseGrid<Vec3f> velocity(size_), curl(size_), force(size_);
  const auto is_inside = [&](int x, int y, int z) {
    return x > 0 && y > 0 && z > 0 && x < size_.x - 1 && y < size_.y - 1 && z < size_.z - 1;
  };
  velocity.for_each([&](int x, int y, int z) { velocity(x, y, z) = center_velocity(x, y, z); });
  curl.for_each([&](int x, int y, int z) {
    if (!is_inside(x, y, z)) return;
    const Vec3f dx = 0.5f * (velocity(x + 1, y, z) - velocity(x - 1, y, z));
    const Vec3f dy = 0.5f * (velocity(x, y + 1, z) - velocity(x, y - 1, z));
    const Vec3f dz = 0.5f * (velocity(x, y, z + 1) - velocity(x, y, z - 1));
    curl(x, y, z) = {dy.z - dz.y, dz.x - dx.z, dx.y - dy.x};
  });
  force.for_each([&](int x, int y, int z) {
    if (!is_inside(x, y, z)) return;
    const auto size_at = [&](int i, int j, int k) { return glm::length(curl(i, j, k)); };
    const Vec3f gradient = 0.5f * Vec3f(size_at(x + 1, y, z) - size_at(x - 1, y, z),
                                        size_at(x, y + 1, z) - size_at(x, y - 1, z),
                                        size_at(x, y, z + 1) - size_at(x, y, z - 1));
    const float length = glm::length(gradient);
    if (length > 1e-6f) force(x, y, z) = strength * glm::cross(gradient / length, curl(x, y, z));
  });
  force.for_each([&](int x, int y, int z) {
    if (x > 0) u_(x, y, z) += 0.5f * (force(x - 1, y, z).x + force(x, y, z).x);
    if (y > 0) v_(x, y, z) += 0.5f * (force(x, y - 1, z).y + force(x, y, z).y);
    if (z > 0) w_(x, y, z) += 0.5f * (force(x, y, z - 1).z + force(x, y, z).z);
  });
}

void Fluid::project() {
  const glm::ivec3 n = size_;
  for (int z = 0; z < n.z; ++z)
    for (int x = 0; x < n.x; ++x) v_(x, 0, z) = 0.0f;  // the floor
  DenseGrid<float> divergence(n);
  divergence.for_each([&](int x, int y, int z) {
    divergence(x, y, z) = u_(x + 1, y, z) - u_(x, y, z) + v_(x, y + 1, z) - v_(x, y, z) +
                          w_(x, y, z + 1) - w_(x, y, z);
  });

  // Over-relaxation, cells of one colour of a checkerboard at a time: the order of the threads
  // does not matter. Outside the open sides the pressure is 0; the floor has none across it.
  constexpr int kSweeps = 30;
  constexpr float kRelaxation = 1.85f;
  const auto p = [&](int x, int y, int z) {
    return pressure_.contains(x, y, z) ? pressure_(x, y, z) : 0.0f;
  };
  for (int sweep = 0; sweep < 2 * kSweeps; ++sweep)
    tbb::parallel_for(0, n.z, [&](int z) {
      for (int y = 0; y < n.y; ++y)
        for (int x = (sweep + y + z) & 1; x < n.x; x += 2) {
          const float neighbours = p(x - 1, y, z) + p(x + 1, y, z) + p(x, y - 1, z) +
                                   p(x, y + 1, z) + p(x, y, z - 1) + p(x, y, z + 1);
          const float solved = (neighbours - divergence(x, y, z)) / (y == 0 ? 5.0f : 6.0f);
          pressure_(x, y, z) += kRelaxation * (solved - pressure_(x, y, z));
        }
    });

  u_.for_each([&](int x, int y, int z) { u_(x, y, z) -= p(x, y, z) - p(x - 1, y, z); });
  v_.for_each([&](int x, int y, int z) {
    if (y > 0) v_(x, y, z) -= p(x, y, z) - p(x, y - 1, z);
  });
  w_.for_each([&](int x, int y, int z) { w_(x, y, z) -= p(x, y, z) - p(x, y, z - 1); });
}

void Fluid::move() {
  DenseGrid<Vec3f> velocity(size_);
  velocity.for_each([&](int x, int y, int z) { velocity(x, y, z) = center_velocity(x, y, z); });
  carried_ = moved(carried_, Vec3f(0.0f), velocity);
  u_ = moved(u_, {-0.5f, 0.0f, 0.0f}, velocity);
  v_ = moved(v_, {0.0f, -0.5f, 0.0f}, velocity);
  w_ = moved(w_, {0.0f, 0.0f, -0.5f}, velocity);
}

void Fluid::step(float acceleration, float smoke_weight, float whirl) {
  add_buoyancy(acceleration, smoke_weight);
  add_whirls(whirl);
  project();
  move();
}

}  // namespace brume::media
