// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace brume {

class Film;

/// How far a picture is from its converged self, estimated from its own samples. It says nothing
/// about bias.
struct PictureError {
  double relative_rms;  // 0.01 is one percent
  double upper_bound;   // the true error lies below it with a confidence of 95%
};

/// Both are infinite while nothing is known: while a pixel has fewer than two samples, or all are
/// black. Pixels all of whose samples were bad are left out.
///
/// The squared standard errors of the pixels add up to the squared error of the picture. What that
/// sum may miss is bounded as for a weighted sum of rare events (Fay and Feuer 1997): it is taken
/// to hold one more pixel as bad as the worst that was seen, which is what protects against light
/// that few samples find.
PictureError picture_error(const Film& film);

/// The relative RMSE of brume, of renders, comparisons and studies alike: the root of the squared
/// error averaged over all pixels and channels, over the mean radiance of the picture (of the
/// reference where there is one). 0 of a picture without error, however dark.
inline double relative_rmse(double mean_squared_error, double mean_radiance) {
  return mean_squared_error > 0.0 ? std::sqrt(mean_squared_error) / mean_radiance : 0.0;
}

}  // namespace brume
