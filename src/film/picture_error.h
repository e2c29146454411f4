// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

class Film;

/// How far a picture is from its converged self: the root mean square of the standard errors of
/// all pixels and channels, over the mean radiance of the picture. It says nothing about bias.
struct PictureError {
  double relative_rms;  // 0.01 is one percent; infinite when a pixel has fewer than two samples
  double upper_bound;   // `relative_rms` lies below it with a confidence of 95%
};

PictureError picture_error(const Film& film);

}  // namespace brume
