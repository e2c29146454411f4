// SPDX-License-Identifier: Apache-2.0
#include "io/spectrum.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace brume {
namespace {

constexpr double kFirst_nm = 380.0, kLast_nm = 780.0;
constexpr double kColourStep_nm = 5.0, kD65Step_nm = 10.0;

// Colour matching functions x, y, z of the CIE 1931 2-degree observer (CIE 015:2004, table T.4).
const std::array<glm::dvec3, 81> kCie1931 = {{glm::dvec3{0.001368, 0.000039, 0.00645},
                                              glm::dvec3{0.002236, 0.000064, 0.01055},
                                              glm::dvec3{0.004243, 0.00012, 0.02005},
                                              glm::dvec3{0.00765, 0.000217, 0.03621},
                                              glm::dvec3{0.01431, 0.000396, 0.06785},
                                              glm::dvec3{0.02319, 0.00064, 0.1102},
                                              glm::dvec3{0.04351, 0.00121, 0.2074},
                                              glm::dvec3{0.07763, 0.00218, 0.3713},
                                              glm::dvec3{0.13438, 0.004, 0.6456},
                                              glm::dvec3{0.21477, 0.0073, 1.03905},
                                              glm::dvec3{0.2839, 0.0116, 1.3856},
                                              glm::dvec3{0.3285, 0.01684, 1.62296},
                                              glm::dvec3{0.34828, 0.023, 1.74706},
                                              glm::dvec3{0.34806, 0.0298, 1.7826},
                                              glm::dvec3{0.3362, 0.038, 1.77211},
                                              glm::dvec3{0.3187, 0.048, 1.7441},
                                              glm::dvec3{0.2908, 0.06, 1.6692},
                                              glm::dvec3{0.2511, 0.0739, 1.5281},
                                              glm::dvec3{0.19536, 0.09098, 1.28764},
                                              glm::dvec3{0.1421, 0.1126, 1.0419},
                                              glm::dvec3{0.09564, 0.13902, 0.81295},
                                              glm::dvec3{0.05795, 0.1693, 0.6162},
                                              glm::dvec3{0.03201, 0.20802, 0.46518},
                                              glm::dvec3{0.0147, 0.2586, 0.3533},
                                              glm::dvec3{0.0049, 0.323, 0.272},
                                              glm::dvec3{0.0024, 0.4073, 0.2123},
                                              glm::dvec3{0.0093, 0.503, 0.1582},
                                              glm::dvec3{0.0291, 0.6082, 0.1117},
                                              glm::dvec3{0.06327, 0.71, 0.07825},
                                              glm::dvec3{0.1096, 0.7932, 0.05725},
                                              glm::dvec3{0.1655, 0.862, 0.04216},
                                              glm::dvec3{0.22575, 0.91485, 0.02984},
                                              glm::dvec3{0.2904, 0.954, 0.0203},
                                              glm::dvec3{0.3597, 0.9803, 0.0134},
                                              glm::dvec3{0.43345, 0.99495, 0.00875},
                                              glm::dvec3{0.51205, 1, 0.00575},
                                              glm::dvec3{0.5945, 0.995, 0.0039},
                                              glm::dvec3{0.6784, 0.9786, 0.00275},
                                              glm::dvec3{0.7621, 0.952, 0.0021},
                                              glm::dvec3{0.8425, 0.9154, 0.0018},
                                              glm::dvec3{0.9163, 0.87, 0.00165},
                                              glm::dvec3{0.9786, 0.8163, 0.0014},
                                              glm::dvec3{1.0263, 0.757, 0.0011},
                                              glm::dvec3{1.0567, 0.6949, 0.001},
                                              glm::dvec3{1.0622, 0.631, 0.0008},
                                              glm::dvec3{1.0456, 0.5668, 0.0006},
                                              glm::dvec3{1.0026, 0.503, 0.00034},
                                              glm::dvec3{0.9384, 0.4412, 0.00024},
                                              glm::dvec3{0.85445, 0.381, 0.00019},
                                              glm::dvec3{0.7514, 0.321, 0.0001},
                                              glm::dvec3{0.6424, 0.265, 0.00005},
                                              glm::dvec3{0.5419, 0.217, 0.00003},
                                              glm::dvec3{0.4479, 0.175, 0.00002},
                                              glm::dvec3{0.3608, 0.1382, 0.00001},
                                              glm::dvec3{0.2835, 0.107, 0},
                                              glm::dvec3{0.2187, 0.0816, 0},
                                              glm::dvec3{0.1649, 0.061, 0},
                                              glm::dvec3{0.1212, 0.04458, 0},
                                              glm::dvec3{0.0874, 0.032, 0},
                                              glm::dvec3{0.0636, 0.0232, 0},
                                              glm::dvec3{0.04677, 0.017, 0},
                                              glm::dvec3{0.0329, 0.01192, 0},
                                              glm::dvec3{0.0227, 0.00821, 0},
                                              glm::dvec3{0.01584, 0.005723, 0},
                                              glm::dvec3{0.011359, 0.004102, 0},
                                              glm::dvec3{0.008111, 0.002929, 0},
                                              glm::dvec3{0.00579, 0.002091, 0},
                                              glm::dvec3{0.004109, 0.001484, 0},
                                              glm::dvec3{0.002899, 0.001047, 0},
                                              glm::dvec3{0.002049, 0.00074, 0},
                                              glm::dvec3{0.00144, 0.00052, 0},
                                              glm::dvec3{0.001, 0.000361, 0},
                                              glm::dvec3{0.00069, 0.000249, 0},
                                              glm::dvec3{0.000476, 0.000172, 0},
                                              glm::dvec3{0.000332, 0.00012, 0},
                                              glm::dvec3{0.000235, 0.000085, 0},
                                              glm::dvec3{0.000166, 0.00006, 0},
                                              glm::dvec3{0.000117, 0.000042, 0},
                                              glm::dvec3{0.000083, 0.00003, 0},
                                              glm::dvec3{0.000059, 0.000021, 0},
                                              glm::dvec3{0.000042, 0.000015, 0}}};

// Relative spectral power of CIE standard illuminant D65 (CIE 015:2004, table T.1); between its
// values it is linear by definition.
constexpr std::array<double, 41> kD65 = {
    49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865, 117.008, 117.812,
    114.861, 115.923, 108.811, 109.354, 107.802, 104.79,  107.689, 104.405, 104.046,
    100.0,   96.3342, 95.788,  88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
    80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349,  61.604,  69.8856,
    75.087,  63.5927, 46.4182, 66.8054, 63.3828};

template <class Table>
auto interpolated(const Table& table, double step_nm, double wavelength_nm) {
  const double x = (wavelength_nm - kFirst_nm) / step_nm;
  const std::size_t i = std::min(std::size_t(x), table.size() - 2);
  const double f = x - double(i);
  return table[i] * (1.0 - f) + table[i + 1] * f;
}

double value_at(const Spectrum& s, double wavelength_nm) {
  if (s.is_uniform()) return s.values[0];
  const auto above =
      std::upper_bound(s.wavelengths_nm.begin(), s.wavelengths_nm.end(), wavelength_nm);
  if (above == s.wavelengths_nm.begin()) return 0.0;
  const std::size_t i = std::size_t(above - s.wavelengths_nm.begin());
  if (above == s.wavelengths_nm.end()) {
    return wavelength_nm == s.wavelengths_nm.back() ? s.values.back() : 0.0;
  }
  const double f =
      (wavelength_nm - s.wavelengths_nm[i - 1]) / (s.wavelengths_nm[i] - s.wavelengths_nm[i - 1]);
  return s.values[i - 1] * (1.0 - f) + s.values[i] * f;
}

// CIE XYZ of the spectrum under an illuminant, relative to that of a perfect white.
template <class Illuminant>
glm::dvec3 relative_xyz(const Spectrum& s, const Illuminant& illuminant) {
  constexpr int kSteps = 1600;  // 0.25 nm: fine against every table and every measured spectrum
  glm::dvec3 sum(0.0), white(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double wavelength_nm = kFirst_nm + (i + 0.5) * (kLast_nm - kFirst_nm) / kSteps;
    const glm::dvec3 response =
        interpolated(kCie1931, kColourStep_nm, wavelength_nm) * illuminant(wavelength_nm);
    sum += response * value_at(s, wavelength_nm);
    white += response;
  }
  return sum / white;
}

// Linear Rec. 709 from XYZ relative to the luminance of white (ITU-R BT.709 primaries, D65).
const glm::dvec3 kWhiteD65(0.950456, 1.0, 1.089058);
glm::dvec3 rec709(const glm::dvec3& xyz) {
  return {3.240479 * xyz.x - 1.537150 * xyz.y - 0.498535 * xyz.z,
          -0.969256 * xyz.x + 1.875991 * xyz.y + 0.041556 * xyz.z,
          0.055648 * xyz.x - 0.204043 * xyz.y + 1.057311 * xyz.z};
}

}  // namespace

glm::dvec3 emission_to_rgb(const Spectrum& spectrum) {
  assert(!spectrum.values.empty());
  return rec709(relative_xyz(spectrum, [](double) { return 1.0; }));
}

glm::dvec3 reflectance_to_rgb(const Spectrum& spectrum) {
  assert(!spectrum.values.empty());
  if (spectrum.is_uniform()) return glm::dvec3(spectrum.values[0]);
  const auto d65 = [](double nm) { return interpolated(kD65, kD65Step_nm, nm); };
  // The published matrix takes D65 to white with an error of 2e-4, which grey must not show.
  return rec709(relative_xyz(spectrum, d65) * kWhiteD65) / rec709(kWhiteD65);
}

}  // namespace brume
