// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace brume::test {

/// Mean and its standard error, in double (Welford 1962).
class RunningMean {
 public:
  void add(double x) {
    ++n_;
    const double delta = x - mean_;
    mean_ += delta / double(n_);
    m2_ += delta * (x - mean_);
  }
  double mean() const { return mean_; }
  double standard_error() const {
    return n_ > 1 ? std::sqrt(m2_ / (double(n_) * double(n_ - 1))) : INFINITY;
  }
  std::int64_t count() const { return n_; }

 private:
  std::int64_t n_ = 0;
  double mean_ = 0.0, m2_ = 0.0;
};

/// Largest |mean - want| / standard error that passes; with fixed seeds a pass stays a pass.
inline constexpr double kMaxZ = 4.5;

/// |mean - want| within kMaxZ standard errors; exact agreement passes when there is no spread.
/// `rounding` is the absolute error that float arithmetic may add.
inline ::testing::AssertionResult agrees(const RunningMean& got, double want,
                                         double rounding = 0.0) {
  const double tolerance = kMaxZ * got.standard_error() + rounding;
  if (std::abs(got.mean() - want) <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "mean " << got.mean() << " +- " << got.standard_error() << " (n " << got.count()
         << ") differs from " << want << " by z = " << (got.mean() - want) / got.standard_error();
}

/// Two independent means agree.
inline ::testing::AssertionResult agree(const RunningMean& a, const RunningMean& b,
                                        double rounding = 0.0) {
  const double se = std::hypot(a.standard_error(), b.standard_error());
  if (std::abs(a.mean() - b.mean()) <= kMaxZ * se + rounding) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << a.mean() << " +- " << a.standard_error() << " differs from " << b.mean() << " +- "
         << b.standard_error() << " by z = " << (a.mean() - b.mean()) / se;
}

}  // namespace brume::test
