// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "film/image.h"
#include "study/same_picture.h"

namespace brume {

/// A pixel in which two pictures differ.
struct PixelDifference {
  int x, y;  // from the top left
  glm::dvec3 value, reference;
  double squared_error;  // mean over the channels
};

/// How picture A differs from the reference B. Errors are averaged over all pixels and channels.
struct Comparison {
  glm::dvec3 mean, reference_mean;  // of A and B per channel
  glm::dvec3 bias{0.0};             // mean of A - B per channel
  /// Standard error of `bias`, where a picture has error layers; allows for pixels that share light
  /// paths (GroupedSum), and is a few percent too large where none do.
  std::optional<glm::dvec3> bias_error{};
  double rmse = 0.0;
  double relative_rmse = 0.0;  // as in film/picture_error.h
  /// Mean of (A - B)^2 / (B^2 + epsilon^2): every pixel counts by its own brightness, and those
  /// much darker than `epsilon` by that.
  double relative_mse = 0.0;
  double epsilon = 0.0;                  // `dark_level` of B
  double psnr = 0.0;                     // [dB] against B's largest value; infinite: no error
  std::vector<PixelDifference> worst{};  // by squared error, the worst first; at most five
  std::optional<SamePicture> same{};     // where a picture has error layers
};

/// Mean over the channels of (value - reference)^2 / (reference^2 + epsilon^2).
double relative_squared_error(const glm::dvec3& value, const glm::dvec3& reference, double epsilon);

/// Radiance below which pixels count as dark: a hundredth of the picture's mean.
double dark_level(const Picture& reference);

/// Throws Error when the pictures differ in size. Both have R, G and B.
Comparison compare(const Image& a, const Image& reference);

}  // namespace brume
