// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "film/image.h"

namespace brume {

/// Where a relative error lies on the scale of heat maps: 0 for 0.1% and less, 1 for 100% and
/// more, equal ratios equally far apart. The scale is fixed, so that maps can be compared.
double heat_position(double relative_error);

/// One mark of the scale's legend: "1%" at its `heat_position`.
struct HeatMark {
  double position;
  std::string label;
};
std::vector<HeatMark> heat_marks();

/// Relative error of each pixel of `a` against `reference`, in the colours of `scale_colour`: the
/// root of `relative_squared_error`. Pictures have the same size.
Image heat_map(const Image& a, const Image& reference);

/// `map` enlarged, where it is small, until its legend fits under it.
Image with_legend(const Image& map);

}  // namespace brume
