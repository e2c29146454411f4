// SPDX-License-Identifier: Apache-2.0
#include "light/sky.h"

#include <array>
#include <cassert>
#include <cmath>

namespace brume {
namespace {

using Rgbd = glm::dvec3;

constexpr double kGroundAlbedo = 0.2;

/// Linear Rec. 709 (ITU-R BT.709, D65) of a chromaticity (x, y) and luminance Y, with colours
/// outside the gamut clamped to it.
Rgbd from_xyY(double x, double y, double Y) {
  const double X = x / y * Y, Z = (1.0 - x - y) / y * Y;
  return glm::max(Rgbd(3.2406 * X - 1.5372 * Y - 0.4986 * Z, -0.9689 * X + 1.8758 * Y + 0.0415 * Z,
                       0.0557 * X - 0.2040 * Y + 1.0570 * Z),
                  Rgbd(0.0));
}

double luminance_of(const Rgbd& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// Sky of Preetham, Shirley and Smits 1999 (appendix A.2), in kcd/m^2.
class PreethamSky {
 public:
  PreethamSky(const Vec3& to_sun, double T) : to_sun_(to_sun) {
    const double sun = std::acos(std::min(1.0, to_sun_.y));  // zenith angle
    perez_ = {{{0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251,
                0.1206 * T - 2.5771, -0.0670 * T + 0.3703},
               {-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125,
                -0.0641 * T - 0.8989, -0.0033 * T + 0.0452},
               {-0.0167 * T - 0.2608, -0.0950 * T + 0.0092, -0.0079 * T + 0.2102,
                -0.0441 * T - 1.6537, -0.0109 * T + 0.0529}}};

    const double chi = (4.0 / 9.0 - T / 120.0) * (M_PI - 2.0 * sun);
    const std::array<double, 3> at_zenith{
        (4.0453 * T - 4.9710) * std::tan(chi) - 0.2155 * T + 2.4192,
        T * T * cubic(sun, 0.00166, -0.00375, 0.00209, 0.0) +
            T * cubic(sun, -0.02903, 0.06377, -0.03202, 0.00394) +
            cubic(sun, 0.11693, -0.21196, 0.06052, 0.25886),
        T * T * cubic(sun, 0.00275, -0.00610, 0.00317, 0.0) +
            T * cubic(sun, -0.04214, 0.08970, -0.04153, 0.00516) +
            cubic(sun, 0.15346, -0.26756, 0.06670, 0.26688)};
    for (int i = 0; i < 3; ++i) scale_[i] = at_zenith[i] / perez(perez_[i], 1.0, sun);
  }

  /// Seen along the unit direction `d`, on or above the horizon. A sky is smooth: more pixels would
  /// change it less than its model is worth, and no
  /// longer fit the nearer caches.
  Rgbd radiance(const glm::dvec3& d) const {
    const double gamma = std::acos(std::clamp(glm::dot(d, to_sun_), -1.0, 1.0));
    std::array<double, 3> Yxy;
    for (int i = 0; i < 3; ++i) Yxy[i] = scale_[i] * perez(perez_[i], d.y, gamma);
    return from_xyY(Yxy[1], Yxy[2], std::max(0.0, Yxy[0]));
  }

 private:
  using Coefficients = std::array<double, 5>;

  static double cubic(double x, double a, double b, double c, double d) {
    return ((a * x + b) * x + c) * x + d;
  }

  /// Relative distribution of Perez et al. 1993: `cos_theta` from the zenith, `gamma` from the sun.
  static double perez(const Coefficients& c, double cos_theta, double gamma) {
    const double cos_gamma = std::cos(gamma);
    return (1.0 + c[0] * std::exp(c[1] / std::max(cos_theta, 1e-6))) *
           (1.0 + c[2] * std::exp(c[3] * gamma) + c[4] * cos_gamma * cos_gamma);
  }

  glm::dvec3 to_sun_;
  std::array<Coefficients, 3> perez_;  // A to E of luminance Y and chromaticity x, y
  std::array<double, 3> scale_;        // Y [kcd/m^2], x, y where the distribution is 1
};

/// Light of the sun on a surface across it, in klx: what enters the atmosphere, dimmed by
/// molecules and haze (Preetham et al. 1999, appendix A.1; ozone and water are left out). One
/// wavelength stands for each channel.
Rgbd sun_illuminance(double cos_zenith, double turbidity) {
  // Luminous solar constant 133.3 klx (Darula, Kittler and Gueymard 2005), in the colour of a
  // Planckian radiator at the sun's effective temperature of 5772 K.
  const Rgbd extraterrestrial = from_xyY(0.3263, 0.3357, 133.3);
  constexpr std::array<double, 3> kWavelength{0.610, 0.550, 0.465};  // [um]

  const double zenith_deg = std::acos(std::min(1.0, cos_zenith)) * 180.0 / M_PI;
  const double air_mass = 1.0 / (cos_zenith + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
  const double beta = 0.04608 * turbidity - 0.04586;
  Rgbd transmittance(0.0);
  for (int i = 0; i < 3; ++i) {
    const double tau =
        0.008735 * std::pow(kWavelength[i], -4.08) + beta * std::pow(kWavelength[i], -1.3);
    transmittance[i] = std::exp(-tau * air_mass);
  }
  return extraterrestrial * transmittance;
}

/// Rows and columns of the picture of the sky. The number of rows is odd, so that one of them is
/// the horizon.
constexpr std::size_t kWidth = 256, kHeight = 129, kHorizon = kHeight / 2;

glm::dvec3 pixel_direction(std::size_t column, std::size_t row) {
  const double phi = 2.0 * M_PI * (double(column) + 0.5) / double(kWidth);
  const double theta = M_PI * double(row) / double(kHeight - 1);
  return {std::sin(theta) * std::sin(phi), row == kHorizon ? 0.0 : std::cos(theta),
          -std::sin(theta) * std::cos(phi)};
}

/// Irradiance that the rows [begin, end) of a picture bring to a surface with normal `n`.
Rgbd irradiance(const std::vector<Rgbd>& pixels, std::size_t begin, std::size_t end,
                const glm::dvec3& n) {
  const double area = 2.0 * M_PI / double(kWidth) * M_PI / double(kHeight - 1);
  Rgbd sum(0.0);
  for (std::size_t row = begin; row < end; ++row) {
    const double solid_angle = area * std::sin(M_PI * double(row) / double(kHeight - 1));
    for (std::size_t column = 0; column < kWidth; ++column) {
      const double cosine = glm::dot(n, pixel_direction(column, row));
      sum += std::max(0.0, cosine) * solid_angle * pixels[row * kWidth + column];
    }
  }
  return sum;
}

}  // namespace

Daylight make_daylight(const Vec3& to_sun, float turbidity) {
  assert(to_sun.y >= 0.0f && turbidity >= 2.0f && turbidity <= 10.0f);
  const PreethamSky sky(to_sun, turbidity);
  const Rgbd sun = sun_illuminance(to_sun.y, turbidity);

  std::vector<Rgbd> pixels(kWidth * kHeight, Rgbd(0.0));
  for (std::size_t row = 0; row <= kHorizon; ++row)
    for (std::size_t column = 0; column < kWidth; ++column)
      pixels[row * kWidth + column] = sky.radiance(pixel_direction(column, row));

  const Rgbd on_ground =
      irradiance(pixels, 0, kHorizon, glm::dvec3(0.0, 1.0, 0.0)) + double(to_sun.y) * sun;
  std::fill(pixels.begin() + (kHorizon + 1) * kWidth, pixels.end(),
            kGroundAlbedo / M_PI * on_ground);

  const Rgbd facing_sun = irradiance(pixels, 0, kHeight, to_sun) + sun;
  const double scale = M_PI / luminance_of(facing_sun);
  return {.sky = std::make_shared<EnvironmentMap>(std::vector<Rgb>(pixels.begin(), pixels.end()),
                                                  kWidth, kHeight, glm::dmat4(1.0),
                                                  static_cast<float>(scale)),
          .sun = std::make_shared<DistantDiskLight>(-to_sun, kSunAngularRadius, Rgb(scale * sun))};
}

}  // namespace brume
