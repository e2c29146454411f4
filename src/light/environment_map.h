// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/distribution.h"
#include "light/environment_light.h"

namespace brume {

/// A latitude-longitude picture at infinity, interpolated bilinearly, in the convention of
/// Mitsuba 3: +Y is up, u = atan2(x, -z) / 2 pi and v = acos(y) / pi.
///
/// Columns wrap around and column i is centred at u = (i + 1/2) / width; rows go from pole to pole
/// and row j is centred at v = j / (height - 1):
///
///     v = 0   row 0           zenith, +Y
///             row j
///     v = 1   row height - 1  nadir
///
/// Directions are sampled in proportion to the luminance, with a density that is bilinear between
/// pixels in (azimuth, cosine of the polar angle); the picture is bilinear in (azimuth, polar
/// angle). The two are zero in the same places and all but equal away from the poles.
class EnvironmentMap final : public EnvironmentLight {
 public:
  /// `pixels` are rows from the top, finite and not negative, `width` >= 1, `height` >= 2; times
  /// `scale` >= 0 they are radiance [W/(m^2 sr)]. The linear part of `to_world` is a rotation,
  /// perhaps mirrored or scaled uniformly.
  EnvironmentMap(std::vector<Rgb> pixels, std::size_t width, std::size_t height,
                 const glm::dmat4& to_world, float scale);

  std::optional<LightSample> sample(const Vec3& p, const Vec2& u) const override;
  float importance(const Vec3& p) const override;
  View view(const Vec3& d) const override;

 private:
  /// The rectangle between four pixels.
  struct Cell {
    std::size_t column, row;  // of the pixel with the smallest u and v
  };
  /// Position in a cell, from its first pixel, in [0, 1].
  struct Offset {
    float azimuth, polar_angle, cosine;
  };
  struct Corners;

  std::pair<Cell, Offset> locate(const Vec3& d) const;
  Corners corners(const Cell& cell) const;
  double solid_angle(std::size_t row) const;  // of a cell [sr]
  Distribution2d cell_distribution() const;
  double uneven_flux() const;

  std::size_t width_, height_;
  std::vector<Rgb> pixels_;           // [height][width] radiance [W/(m^2 sr)]
  std::vector<double> half_versine_;  // [height] (1 - cos) / 2 of each row's polar angle
  glm::dmat3 to_local_;
  glm::mat3 to_world_;           // of unit vectors
  Distribution2d distribution_;  // of cells, by the flux through them
  double flux_;                  // luminance integrated over the sphere
  float inverse_flux_;           // 0 where there is none
  double uneven_flux_;           // the same of the luminance above its mean
};

}  // namespace brume
