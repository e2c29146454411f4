// SPDX-License-Identifier: Apache-2.0
#include "film/filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace brume {
namespace {

/// Inverse of the cumulative distribution of the tent on [-1, 1].
float sample_tent(float u) {
  return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f * (1.0f - u));
}

constexpr double kGaussianCutoff = 4.0;  // [standard deviations]

/// Integral from 0 to `x` [standard deviations] of the Gaussian less its value at the cutoff.
double lowered_gaussian_integral(double x) {
  const double lowering = std::exp(-0.5 * kGaussianCutoff * kGaussianCutoff);
  return std::sqrt(0.5 * std::acos(-1.0)) * std::erf(x / std::sqrt(2.0)) - lowering * x;
}

}  // namespace

Vec2 TentFilter::sample(const Vec2& u) const {
  return radius_ * Vec2(sample_tent(u.x), sample_tent(u.y));
}

GaussianFilter::GaussianFilter(float stddev)
    : radius_(static_cast<float>(kGaussianCutoff) * stddev) {
  assert(stddev > 0.0f);
  const double total = 2.0 * lowered_gaussian_integral(kGaussianCutoff);
  for (std::size_t i = 0; i <= kBins; ++i) {
    const double x = kGaussianCutoff * (2.0 * double(i) / double(kBins) - 1.0);
    cdf_[i] = 0.5 + lowered_gaussian_integral(x) / total;
  }
  cdf_.back() = 1.0;
  for (std::size_t i = 0; i < kBins; ++i) {
    const auto above = std::upper_bound(cdf_.begin() + 1, cdf_.end(), double(i) / double(kBins));
    first_bin_[i] = static_cast<std::uint16_t>(above - cdf_.begin() - 1);
  }
}

/// The mass of every bin is exact; within one, 1/128 standard deviation wide, the density is taken
/// as constant, far below what a picture shows.
float GaussianFilter::sample_axis(float u) const {
  std::size_t bin = first_bin_[std::size_t(u * float(kBins))];
  while (cdf_[bin + 1] <= u) ++bin;
  const double offset = (u - cdf_[bin]) / (cdf_[bin + 1] - cdf_[bin]);
  return radius_ * static_cast<float>(2.0 * (double(bin) + offset) / double(kBins) - 1.0);
}

Vec2 GaussianFilter::sample(const Vec2& u) const {
  return {sample_axis(u.x), sample_axis(u.y)};
}

}  // namespace brume
