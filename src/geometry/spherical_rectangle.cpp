// SPDX-License-Identifier: Apache-2.0
#include "geometry/spherical_rectangle.h"

#include <algorithm>
#include <complex>

namespace brume {
namespace {

/// Coordinates are floats, whose squares are far from the ends of double: std::hypot, which guards
/// against them, took a tenth of the time of a room lit by one rectangle.
double hypotenuse(double a, double b) {
  return std::sqrt(a * a + b * b);
}

/// Unit normal of the plane through the point and an edge; it lies in the plane of z and one of
/// the axes of the rectangle.
struct EdgeNormal {
  double z, in_plane;
};

/// Inner angle of the spherical rectangle where two edges meet, arccos(-dot) of their normals
/// (eq. 8), as the number of modulus 1 that has it for argument.
std::complex<double> corner(const EdgeNormal& along_x, const EdgeNormal& along_y) {
  const Vec3d cross(along_x.in_plane * along_y.z, along_x.z * along_y.in_plane,
                    along_x.in_plane * along_y.in_plane);
  return {-along_x.z * along_y.z, glm::length(cross)};
}

/// Sum of two inner angles: products add arguments, so that one arc tangent, accurate near 0 and
/// pi, too, serves for both.
double sum_of_angles(const std::complex<double>& a, const std::complex<double>& b) {
  const double real = a.real() * b.real() - a.imag() * b.imag();
  const double imaginary = a.real() * b.imag() + a.imag() * b.real();
  const double angle = std::atan2(imaginary, real);
  return angle < 0.0 ? angle + 2.0 * M_PI : angle;
}

}  // namespace

SphericalRectangle::SphericalRectangle(const Vec3d& from, const Vec3d& center, const Vec3d& a,
                                       const Vec3d& b)
    : half_a_(glm::length(a)), half_b_(glm::length(b)) {
  const Vec3d x = a / half_a_, y = b / half_b_;
  const Vec3d way = center - from;
  const double cx = glm::dot(way, x), cy = glm::dot(way, y);
  x0_ = cx - half_a_;
  x1_ = cx + half_a_;
  y0_ = cy - half_b_;
  y1_ = cy + half_b_;
  z0_ = -std::abs(glm::dot(way, glm::cross(x, y)));
  if (!(z0_ < 0.0)) return;

  const auto normal = [this](double offset) {
    const double length = hypotenuse(offset, z0_);
    return EdgeNormal{.z = offset / length, .in_plane = z0_ / length};
  };
  const EdgeNormal n0 = normal(-y0_), n1 = normal(x1_), n2 = normal(y1_), n3 = normal(-x0_);
  b0_ = n0.z;
  b1_ = n2.z;
  k_ = 2.0 * M_PI - sum_of_angles(corner(n2, n3), corner(n0, n3));
  solid_angle_ = std::max(0.0, sum_of_angles(corner(n0, n1), corner(n2, n1)) - k_);
}

Vec2d SphericalRectangle::sample(const Vec2d& u) const {
  // x such that the part of the rectangle below it has the fraction u.x of the solid angle
  // (section 4, listing 2).
  const double au = u.x * solid_angle_ + k_;
  const double fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
  const double cu = std::clamp(std::copysign(1.0 / hypotenuse(fu, b0_), fu), -1.0, 1.0);
  const double xu = std::clamp(-cu * z0_ / std::sqrt(std::max(1.0 - cu * cu, 1e-300)), x0_, x1_);

  // y uniform in height on the unit sphere, along the meridian of x.
  const double d = hypotenuse(xu, z0_);
  const double h0 = y0_ / hypotenuse(d, y0_), h1 = y1_ / hypotenuse(d, y1_);
  const double hv = h0 + u.y * (h1 - h0);
  const double yv = std::clamp(hv * d / std::sqrt(std::max(1.0 - hv * hv, 1e-300)), y0_, y1_);
  return {(xu - x0_) / half_a_ - 1.0, (yv - y0_) / half_b_ - 1.0};
}

}  // namespace brume
