// SPDX-License-Identifier: Apache-2.0
#include "camera/field_of_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brume {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// Width, at distance 1, of what a horizontal field of view covers.
double width(double x_fov) {
  return 2.0 * std::tan(0.5 * x_fov);
}

TEST(FieldOfView, SpansTheSideItNames) {
  const double want = width(40.0 * kDegree);
  for (const double aspect : {0.5, 1.0, 1.5, 2.35}) {
    const auto width_for = [&](FovAxis axis) {
      return width(horizontal_fov(40.0 * kDegree, axis, aspect));
    };
    EXPECT_NEAR(width_for(FovAxis::kX), want, 1e-14);
    EXPECT_NEAR(width_for(FovAxis::kY) / aspect, want, 1e-14);
    EXPECT_NEAR(std::hypot(width_for(FovAxis::kDiagonal), width_for(FovAxis::kDiagonal) / aspect),
                want, 1e-14);
    EXPECT_NEAR(width_for(FovAxis::kSmaller) * std::min(1.0, 1.0 / aspect), want, 1e-14);
    EXPECT_NEAR(width_for(FovAxis::kLarger) * std::max(1.0, 1.0 / aspect), want, 1e-14);
  }
}

TEST(FieldOfView, FocalLengthProjectsTheFilmFrame) {
  // At the focal length in mm, the field is as large as the 36 x 24 mm frame.
  const double diagonal = diagonal_fov_of_focal_length(50.0);
  const double x_fov = horizontal_fov(diagonal, FovAxis::kDiagonal, 36.0 / 24.0);
  EXPECT_NEAR(50.0 * width(x_fov), 36.0, 1e-12);
  EXPECT_NEAR(x_fov / kDegree, 39.5978, 1e-4);
}

}  // namespace
}  // namespace brume
