// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace brume {

class Film;

/// How far a picture is from its converged self: the root mean square of the standard errors of
/// all pixels and channels, over the mean radiance of the picture. It says nothing about bias.
struct PictureError {
  double relative_rms;  // 0.01 is one percent; infinite when a pixel has fewer than two samples
  double upper_bound;   // `relative_rms` lies below it with a confidence of 95%
};

PictureError picture_error(const Film& film);

/// The relative RMSE of brume, of renders, comparisons and studies alike: the root of the squared
/// error averaged over all pixels and channels, over the mean radiance of the picture (of the
/// reference where there is one). 0 of a picture without error, however dark.
inline double relative_rmse(double mean_squared_error, double mean_radiance) {
  return mean_squared_error > 0.0 ? std::sqrt(mean_squared_error) / mean_radiance : 0.0;
}

}  // namespace brume
