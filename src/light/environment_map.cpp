// SPDX-License-Identifier: Apache-2.0
#include "light/environment_map.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "light/importance.h"

namespace brume {
namespace {

/// sin^2(theta / 2) = (1 - cos theta) / 2, without cancellation at small angles.
double half_versine(double theta) {
  const double s = std::sin(0.5 * theta);
  return s * s;
}

std::vector<double> half_versines(std::size_t height) {
  std::vector<double> result(height);
  for (std::size_t row = 0; row < height; ++row)
    result[row] = half_versine(M_PI * double(row) / double(height - 1));
  return result;
}

float interpolate(float a, float b, float t) {
  return (1.0f - t) * a + t * b;
}

/// Point of [0, 1] with a density linear from `a` at 0 to `b` at 1; both >= 0. The inverse CDF
/// with its quadratic solved without cancellation.
float sample_linear(float a, float b, float u) {
  if (!(a + b > 0.0f)) return u;
  return std::min(1.0f, u * (a + b) / (a + std::sqrt(interpolate(a * a, b * b, u))));
}

std::vector<Rgb> scaled(std::vector<Rgb> pixels, float scale) {
  for (Rgb& pixel : pixels) {
    pixel *= scale;
    assert(is_finite_and_non_negative(pixel));
  }
  return pixels;
}

}  // namespace

/// The pixels at the corners of a cell; the first index is the row.
struct EnvironmentMap::Corners {
  Rgb p00, p01, p10, p11;

  Rgb radiance(const Offset& o) const {
    return glm::mix(glm::mix(p00, p01, o.azimuth), glm::mix(p10, p11, o.azimuth), o.polar_angle);
  }
  /// Density of sampling, times the flux.
  float density(const Offset& o) const {
    return interpolate(interpolate(luminance(p00), luminance(p01), o.azimuth),
                       interpolate(luminance(p10), luminance(p11), o.azimuth), o.cosine);
  }
  float mean_density() const {
    return 0.25f * (luminance(p00) + luminance(p01) + luminance(p10) + luminance(p11));
  }
};

EnvironmentMap::EnvironmentMap(std::vector<Rgb> pixels, std::size_t width, std::size_t height,
                               const glm::dmat4& to_world, float scale)
    : width_(width),
      height_(height),
      pixels_(scaled(std::move(pixels), scale)),
      half_versine_(half_versines(height)),
      to_local_(glm::inverse(glm::dmat3(to_world))),
      to_world_(glm::dmat3(to_world) / glm::length(glm::dvec3(to_world[0]))),
      distribution_(cell_distribution()),
      flux_(distribution_.total()),
      inverse_flux_(flux_ > 0.0 ? float(1.0 / flux_) : 0.0f),
      uneven_flux_(uneven_flux()) {
  assert(width >= 1 && height >= 2 && pixels_.size() == width * height);
}

double EnvironmentMap::solid_angle(std::size_t row) const {
  return 4.0 * M_PI / double(width_) * (half_versine_[row + 1] - half_versine_[row]);
}

Distribution2d EnvironmentMap::cell_distribution() const {
  std::vector<float> flux;
  flux.reserve(width_ * (height_ - 1));
  for (std::size_t row = 0; row + 1 < height_; ++row)
    for (std::size_t column = 0; column < width_; ++column)
      flux.push_back(
          static_cast<float>(solid_angle(row) * double(corners({column, row}).mean_density())));
  return Distribution2d(flux, width_, height_ - 1);
}

double EnvironmentMap::uneven_flux() const {
  // Rounding makes no picture uneven.
  const double mean = flux_ / (4.0 * M_PI) * (1.0 + 1e-5);
  double sum = 0.0;
  for (std::size_t row = 0; row + 1 < height_; ++row)
    for (std::size_t column = 0; column < width_; ++column)
      sum += solid_angle(row) * std::max(0.0, double(corners({column, row}).mean_density()) - mean);
  return sum;
}

EnvironmentMap::Corners EnvironmentMap::corners(const Cell& cell) const {
  const std::size_t next_column = cell.column + 1 == width_ ? 0 : cell.column + 1;
  const Rgb* const above = &pixels_[cell.row * width_];
  const Rgb* const below = above + width_;
  return {.p00 = above[cell.column],
          .p01 = above[next_column],
          .p10 = below[cell.column],
          .p11 = below[next_column]};
}

// Angles are computed in float, which resolves a pixel of a picture 8192 wide to 1/1000. Half
// versines, whose differences between neighbouring rows near a pole are small, are in double.
std::pair<EnvironmentMap::Cell, EnvironmentMap::Offset> EnvironmentMap::locate(
    const Vec3& d) const {
  const glm::dvec3 local = glm::normalize(to_local_ * glm::dvec3(d));
  const float x = std::atan2(float(local.x), -float(local.z)) * (0.5f / kPi) * float(width_) - 0.5f;
  const float column = std::floor(x);
  const float wrapped = column < 0.0f ? column + float(width_) : column;

  const double across = local.x * local.x + local.z * local.z;
  const float theta = std::atan2(float(std::sqrt(across)), float(local.y));
  const float y = theta * (1.0f / kPi) * float(height_ - 1);
  const std::size_t row = std::min(std::size_t(y), height_ - 2);
  const double h =
      local.y > 0.0 ? 0.5 * across / (1.0 + local.y) : 0.5 * (1.0 - local.y);  // no cancellation
  const double cosine = (h - half_versine_[row]) / (half_versine_[row + 1] - half_versine_[row]);
  return {{.column = std::min(std::size_t(wrapped), width_ - 1), .row = row},
          {.azimuth = x - column,
           .polar_angle = std::min(y - float(row), 1.0f),
           .cosine = static_cast<float>(std::clamp(cosine, 0.0, 1.0))}};
}

std::optional<LightSample> EnvironmentMap::sample(const Vec3& /*p*/, const Vec2& u) const {
  if (!(flux_ > 0.0)) return std::nullopt;
  const Distribution2d::Sample chosen = distribution_.sample(u);
  const Cell cell{.column = chosen.column, .row = chosen.row};
  const Corners c = corners(cell);

  // Within the cell, the cosine by its marginal density, then the azimuth.
  const float l00 = luminance(c.p00), l01 = luminance(c.p01);
  const float l10 = luminance(c.p10), l11 = luminance(c.p11);
  const float cosine = sample_linear(l00 + l01, l10 + l11, chosen.offset.y);
  const float azimuth =
      sample_linear(interpolate(l00, l10, cosine), interpolate(l01, l11, cosine), chosen.offset.x);

  // From half the polar angle, whose sine and cosine are known without cancellation.
  const double h =
      std::min(half_versine_[cell.row] +
                   double(cosine) * (half_versine_[cell.row + 1] - half_versine_[cell.row]),
               1.0);
  const float sin_half = std::sqrt(float(h)), cos_half = std::sqrt(float(1.0 - h));
  const float theta = 2.0f * std::atan2(sin_half, cos_half);
  const float polar_angle = theta * (1.0f / kPi) * float(height_ - 1) - float(cell.row);
  const Offset offset{
      .azimuth = azimuth, .polar_angle = std::clamp(polar_angle, 0.0f, 1.0f), .cosine = cosine};

  const float density = c.density(offset) * inverse_flux_;
  if (!(density > 0.0f)) return std::nullopt;
  const float phi = 2.0f * kPi * ((float(cell.column) + 0.5f + azimuth) / float(width_));
  const float sin_theta = 2.0f * sin_half * cos_half;
  const Vec3 local(sin_theta * std::sin(phi), float(1.0 - 2.0 * h), -sin_theta * std::cos(phi));
  return LightSample{.d = glm::normalize(to_world_ * local),
                     .distance = kInfinity,
                     .weight = c.radiance(offset) / density,
                     .pdf = density};
}

EnvironmentLight::View EnvironmentMap::view(const Vec3& d) const {
  const auto [cell, offset] = locate(d);
  const Corners c = corners(cell);
  return {.L = c.radiance(offset), .pdf = c.density(offset) * inverse_flux_};
}

float EnvironmentMap::importance(const Vec3& /*p*/) const {
  return finite(float(uneven_flux_));
}

}  // namespace brume
