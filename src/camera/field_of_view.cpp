// SPDX-License-Identifier: Apache-2.0
#include "camera/field_of_view.h"

#include <cassert>
#include <cmath>

namespace brume {

double horizontal_fov(double fov, FovAxis axis, double aspect) {
  assert(fov > 0.0 && fov < M_PI && aspect > 0.0);
  const double half_side = std::tan(0.5 * fov);
  switch (axis) {
    case FovAxis::kX:
      return fov;
    case FovAxis::kY:
      return 2.0 * std::atan(half_side * aspect);
    case FovAxis::kDiagonal:
      return 2.0 * std::atan(half_side * aspect / std::hypot(aspect, 1.0));
    case FovAxis::kSmaller:
      return horizontal_fov(fov, aspect > 1.0 ? FovAxis::kY : FovAxis::kX, aspect);
    case FovAxis::kLarger:
      return horizontal_fov(fov, aspect > 1.0 ? FovAxis::kX : FovAxis::kY, aspect);
  }
  return fov;
}

double diagonal_fov_of_focal_length(double focal_length_mm) {
  assert(focal_length_mm > 0.0);
  return 2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / focal_length_mm);
}

}  // namespace brume
