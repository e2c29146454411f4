// SPDX-License-Identifier: Apache-2.0
#include "film/picture_error.h"

#include <algorithm>
#include <cmath>

#include "film/film.h"

namespace brume {
namespace {

constexpr double kOneSided95 = 1.6449;  // quantile of the normal distribution

/// The value below which chi-square with `freedom` degrees lies in 95 of 100 cases (Wilson and
/// Hilferty 1931).
double chi_square_95(double freedom) {
  const double spread = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - spread + kOneSided95 * std::sqrt(spread), 3.0);
}

/// Upper limit of a sum of pixels' squared errors (Fay and Feuer 1997: the gamma limit of a
/// weighted sum of Poisson counts, each pixel taken for one count). The error that a pixel did make
/// spreads around the expected one as much as the estimate of that does: for normal errors the
/// square of either has a variance of at most twice the square of its mean, which is the factor 2.
double upper_limit(double sum, double sum_of_squares, double largest) {
  const double mean = sum + largest;
  const double variance = 2.0 * sum_of_squares + largest * largest;
  return variance / (2.0 * mean) * chi_square_95(2.0 * mean * mean / variance);
}

}  // namespace

PictureError picture_error(const Film& film) {
  double radiance = 0.0;        // sum over pixels
  double sum = 0.0;             // over pixels, of the squared standard error
  double sum_of_squares = 0.0;  // of that
  double largest = 0.0;
  double pixels = 0.0;
  for (std::uint32_t y = 0; y < film.height(); ++y) {
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      if (film.drawn(x, y) < 2) return {INFINITY, INFINITY};
      if (film.samples(x, y) < 2) continue;
      const glm::dvec3 error(film.standard_error(x, y));
      const glm::dvec3 L(film.mean(x, y));
      const double squared_error = glm::dot(error, error) / 3.0;
      radiance += (L.r + L.g + L.b) / 3.0;
      sum += squared_error;
      sum_of_squares += squared_error * squared_error;
      largest = std::max(largest, squared_error);
      pixels += 1.0;
    }
  }
  if (pixels == 0.0 || radiance == 0.0) return {INFINITY, INFINITY};
  if (sum == 0.0) return {0.0, 0.0};  // where the limit would be 0 / 0
  const double mean_radiance = radiance / pixels;
  // The picture may be too bright as a whole, too, which makes a relative error look small.
  const double least_radiance = mean_radiance - kOneSided95 * std::sqrt(sum) / pixels;
  if (!(least_radiance > 0.0)) return {relative_rmse(sum / pixels, mean_radiance), INFINITY};
  return {.relative_rms = relative_rmse(sum / pixels, mean_radiance),
          .upper_bound =
              relative_rmse(upper_limit(sum, sum_of_squares, largest) / pixels, least_radiance)};
}

}  // namespace brume
