// SPDX-License-Identifier: Apache-2.0
#include "film/filter.h"

#include <cassert>
#include <cmath>
#include <vector>

namespace brume {
namespace {

/// Inverse of the cumulative distribution of the tent on [-1, 1].
float sample_tent(float u) {
  return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f * (1.0f - u));
}

constexpr double kGaussianCutoff = 4.0;  // [standard deviations]

/// Masses of equal bins over the support of the lowered Gaussian, each integrated exactly. The
/// density is constant within a bin of 1/128 standard deviation, far below what a picture shows.
std::vector<float> gaussian_bins() {
  constexpr int kBins = 1024;
  const double floor = std::exp(-0.5 * kGaussianCutoff * kGaussianCutoff);
  const auto integral = [floor](double x) {  // of exp(-x^2/2) - floor, x in standard deviations
    return std::sqrt(0.5 * std::acos(-1.0)) * std::erf(x / std::sqrt(2.0)) - floor * x;
  };
  std::vector<float> bins(kBins);
  for (int i = 0; i < kBins; ++i) {
    const double left = kGaussianCutoff * (2.0 * i / kBins - 1.0);
    const double right = kGaussianCutoff * (2.0 * (i + 1) / kBins - 1.0);
    bins[std::size_t(i)] = static_cast<float>(integral(right) - integral(left));
  }
  return bins;
}

}  // namespace

Vec2 TentFilter::sample(const Vec2& u) const {
  return radius_ * Vec2(sample_tent(u.x), sample_tent(u.y));
}

GaussianFilter::GaussianFilter(float stddev)
    : radius_(static_cast<float>(kGaussianCutoff) * stddev), distribution_(gaussian_bins()) {
  assert(stddev > 0.0f);
}

Vec2 GaussianFilter::sample(const Vec2& u) const {
  const Vec2 unit(distribution_.sample(u.x).x, distribution_.sample(u.y).x);
  return radius_ * (2.0f * unit - 1.0f);
}

}  // namespace brume
