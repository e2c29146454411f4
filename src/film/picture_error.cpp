// SPDX-License-Identifier: Apache-2.0
#include "film/picture_error.h"

#include <cmath>

#include "film/film.h"

namespace brume {

PictureError picture_error(const Film& film) {
  constexpr double kOneSided95 = 1.6449;  // quantile of the normal distribution
  double radiance = 0.0;                  // running mean over pixels
  double variance = 0.0;                  // running mean over pixels of the squared standard error
  double squares = 0.0;                   // of its deviations from that mean
  double n = 0.0;
  for (std::uint32_t y = 0; y < film.height(); ++y) {
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      if (film.samples(x, y) < 2) return {INFINITY, INFINITY};
      const glm::dvec3 error(film.standard_error(x, y));
      const glm::dvec3 L(film.mean(x, y));
      n += 1.0;
      radiance += ((L.r + L.g + L.b) / 3.0 - radiance) / n;
      const double deviation = glm::dot(error, error) / 3.0 - variance;
      variance += deviation / n;
      squares += deviation * deviation * (1.0 - 1.0 / n);
    }
  }
  if (variance == 0.0) return {0.0, 0.0};
  // The pixels' own differences in noise are part of `squares`, which makes the bound cautious.
  const double spread = n > 1.0 ? std::sqrt(squares / (n * (n - 1.0))) : INFINITY;
  return {.relative_rms = std::sqrt(variance) / radiance,
          .upper_bound = std::sqrt(variance + kOneSided95 * spread) / radiance};
}

}  // namespace brume
