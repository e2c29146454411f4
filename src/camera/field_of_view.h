// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// Side of the picture that a field of view spans.
enum class FovAxis { kX, kY, kDiagonal, kSmaller, kLarger };

/// Horizontal field of view [rad] of a picture of `aspect` = width / height, given the field of
/// view `fov` [rad], in (0, pi), along `axis`.
double horizontal_fov(double fov, FovAxis axis, double aspect);

/// Diagonal field of view [rad] of a lens of `focal_length_mm` > 0 on 35 mm film (36 x 24 mm).
double diagonal_fov_of_focal_length(double focal_length_mm);

}  // namespace brume
