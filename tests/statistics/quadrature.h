// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

namespace brume::test {

/// Integral of f over [a, b] in double: Gauss-Legendre with five points in each of `panels` equal
/// parts. Kinks of f belong on their borders.
template <class F>
double integrate(double a, double b, int panels, F&& f) {
  static const double kInner = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  static const double kOuter = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  static const double kInnerWeight = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0;
  static const double kOuterWeight = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
  static const std::array<std::array<double, 2>, 5> kRule{{{-kOuter, kOuterWeight},
                                                           {-kInner, kInnerWeight},
                                                           {0.0, 128.0 / 225.0},
                                                           {kInner, kInnerWeight},
                                                           {kOuter, kOuterWeight}}};
  const double h = 0.5 * (b - a) / panels;
  double sum = 0.0;
  for (int i = 0; i < panels; ++i) {
    const double middle = a + (2 * i + 1) * h;
    for (const auto& [node, weight] : kRule) sum += weight * f(middle + h * node);
  }
  return h * sum;
}

/// Henyey-Greenstein by its textbook formula [1/sr], `cosine` between directions of travel.
inline double henyey_greenstein(double g, double cosine) {
  return (1.0 - g * g) / (4.0 * M_PI * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

}  // namespace brume::test
