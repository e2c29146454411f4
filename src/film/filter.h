// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/vec.h"

namespace brume {

/// Reconstruction filter, applied by filter importance sampling (Ernst et al. 2006): a camera
/// sample is placed with the filter as its density and counts with weight 1 in its own pixel, so
/// that pixels stay independent. Filters are separable, symmetric and non-negative.
class Filter {
 public:
  virtual ~Filter() = default;

  /// Offset from the pixel centre [pixel].
  virtual Vec2 sample(const Vec2& u) const = 0;
};

/// Constant over `radius` on either side; 0.5 covers the pixel's own square.
class BoxFilter final : public Filter {
 public:
  explicit BoxFilter(float radius = 0.5f) : radius_(radius) {}
  Vec2 sample(const Vec2& u) const override { return radius_ * (2.0f * u - 1.0f); }

 private:
  float radius_;  // [pixel]
};

/// Falls linearly from the centre to zero at `radius`.
class TentFilter final : public Filter {
 public:
  explicit TentFilter(float radius = 1.0f) : radius_(radius) {}
  Vec2 sample(const Vec2& u) const override;

 private:
  float radius_;  // [pixel]
};

/// Gaussian, lowered by its value at 4 standard deviations so that it ends there without a step.
class GaussianFilter final : public Filter {
 public:
  /// `stddev` [pixel] is positive.
  explicit GaussianFilter(float stddev = 0.5f);
  Vec2 sample(const Vec2& u) const override;

 private:
  static constexpr std::size_t kBins = 1024;  // equal ones over [-radius, radius]

  float sample_axis(float u) const;

  float radius_;                                // [pixel]
  std::array<double, kBins + 1> cdf_;           // at the edges of the bins
  std::array<std::uint16_t, kBins> first_bin_;  // that ends above u = i / kBins, for entry i
};

}  // namespace brume
