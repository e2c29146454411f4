// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace brume {

/// Piecewise-constant density over [0, 1) given by non-negative weights; uniform when all are 0.
class Distribution1d {
 public:
  explicit Distribution1d(std::span<const float> weights);

  struct Sample {
    float x;            // [0, 1)
    float pdf;          // density at x
    std::size_t index;  // of the weight
    float offset;       // of x within the interval of that weight, [0, 1)
  };
  Sample sample(float u) const;
  float pdf(float x) const;

  /// Probability of weight `index`.
  float probability(std::size_t index) const;
  double total() const { return total_; }
  std::size_t size() const { return begin_.size(); }

 private:
  /// Where the interval of a weight ends in the CDF, in units of 2^-32.
  std::uint64_t end(std::size_t index) const {
    return index + 1 < begin_.size() ? begin_[index + 1] : std::uint64_t(1) << 32;
  }

  std::vector<std::uint32_t> begin_;  // [size] where intervals begin in the CDF, in 2^-32
  std::vector<std::uint32_t> guide_;  // [size] the interval that i / size lies in
  double total_;                      // sum of the weights
};

/// Piecewise-constant density over [0, 1)^2: rows of `width` weights, row by row from y = 0.
class Distribution2d {
 public:
  Distribution2d(std::span<const float> weights, std::size_t width, std::size_t height);

  struct Sample {
    Vec2 xy;
    float pdf;                // density at xy
    std::size_t column, row;  // of the weight
    Vec2 offset;              // of xy within the rectangle of that weight, [0, 1)^2
  };
  Sample sample(const Vec2& u) const;
  float pdf(const Vec2& xy) const;

  double total() const { return marginal_.total(); }

 private:
  std::vector<Distribution1d> rows_;
  Distribution1d marginal_;
};

}  // namespace brume
