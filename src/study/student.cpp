// SPDX-License-Identifier: Apache-2.0
#include "study/student.h"

#include <cassert>
#include <cmath>

namespace brume {
namespace {

/// Continued fraction of the incomplete beta function, by the modified Lentz method (Press et al.
/// 2007, section 6.4).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  const auto kept_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1.0;
  double d = 1.0 / kept_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  const auto step = [&](double coefficient) {
    d = 1.0 / kept_from_zero(1.0 + coefficient * d);
    c = kept_from_zero(1.0 + coefficient / c);
    fraction *= c * d;
  };
  constexpr int kMaxSteps = 10000;
  for (int i = 1; i < kMaxSteps; ++i) {
    const double m = i;
    const double before = fraction;
    step(m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)));
    step(-(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0)));
    if (std::abs(fraction - before) <= 1e-15 * std::abs(fraction)) break;
  }
  return fraction;
}

/// Regularised incomplete beta function I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  // The fraction converges fast on this side of the mean only.
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

}  // namespace

double student_two_sided(double t, double degrees) {
  assert(degrees > 0.0);
  constexpr double kNormal = 1e6;
  if (degrees >= kNormal) return std::erfc(std::abs(t) / std::sqrt(2.0));
  return incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

}  // namespace brume
