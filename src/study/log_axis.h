// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace brume {

/// A logarithmic axis of a chart: the values `lo` to `hi`, both positive, at the positions `from`
/// to `to`.
struct LogAxis {
  double lo, hi, from, to;

  /// Position of a value; one beyond the axis lies on its end.
  double operator()(double value) const {
    const double u = std::log(std::clamp(value, lo, hi) / lo) / std::log(hi / lo);
    return from + u * (to - from);
  }

  /// A tick at `value`, with a label where there is room.
  struct Tick {
    double value;
    bool labelled;
  };
  /// 1, 2, 5 times powers of ten; on a long axis only the powers are labelled.
  std::vector<Tick> ticks() const {
    const bool is_long = hi / lo > 3e2;
    std::vector<Tick> list;
    for (int power = int(std::floor(std::log10(lo))); std::pow(10.0, power) <= hi; ++power)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, power);
        if (value >= lo * 0.999 && value <= hi * 1.001)
          list.push_back({value, digit == 1.0 || !is_long});
      }
    return list;
  }
};

}  // namespace brume
