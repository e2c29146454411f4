// SPDX-License-Identifier: Apache-2.0
#include "study/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "film/picture_error.h"
#include "study/grouped_sum.h"

namespace brume {
namespace {

constexpr std::size_t kWorst = 5;

/// Keeps the worst few, the worst first.
void keep_worst(std::vector<PixelDifference>& worst, const PixelDifference& pixel) {
  if (pixel.squared_error == 0.0) return;
  if (worst.size() == kWorst && pixel.squared_error <= worst.back().squared_error) return;
  const auto place = std::upper_bound(
      worst.begin(), worst.end(), pixel,
      [](const auto& p, const auto& q) { return p.squared_error > q.squared_error; });
  worst.insert(place, pixel);
  if (worst.size() > kWorst) worst.pop_back();
}

glm::dvec3 mean_of(const Picture& picture) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) sum += picture.colour(x, y);
  return sum / (double(picture.width()) * picture.height());
}

double largest_of(const Picture& picture) {
  double largest = 0.0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const glm::dvec3 c = picture.colour(x, y);
      largest = std::max({largest, c.x, c.y, c.z});
    }
  return largest;
}

}  // namespace

double relative_squared_error(const glm::dvec3& value, const glm::dvec3& reference,
                              double epsilon) {
  const glm::dvec3 d = value - reference;
  if (d == glm::dvec3(0.0)) return 0.0;
  return average(d * d / (reference * reference + epsilon * epsilon));
}

double dark_level(const Picture& reference) {
  return 0.01 * average(mean_of(reference));
}

Comparison compare(const Image& image_a, const Image& image_b) {
  if (image_a.width != image_b.width || image_a.height != image_b.height)
    throw Error(fmt::format("pictures of different sizes cannot be compared: {} x {} and {} x {}",
                            image_a.width, image_a.height, image_b.width, image_b.height));
  const Picture a(image_a), b(image_b);
  const double pixels = double(a.width()) * a.height();

  Comparison result{.mean = mean_of(a), .reference_mean = mean_of(b)};
  const double radiance = average(result.reference_mean);
  result.epsilon = dark_level(b);
  glm::dvec3 difference(0.0);
  std::array<GroupedSum, 3> sums;
  double squares = 0.0, relative_squares = 0.0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const glm::dvec3 value = a.colour(x, y), reference = b.colour(x, y);
      const glm::dvec3 d = value - reference;
      difference += d;
      const glm::dvec3 variance = a.variance(x, y) + b.variance(x, y);
      for (int c = 0; c < 3; ++c) sums[std::size_t(c)].add(x, y, d[c], variance[c]);
      const double squared_error = average(d * d);
      squares += squared_error;
      relative_squares += relative_squared_error(value, reference, result.epsilon);
      keep_worst(result.worst, {x, y, value, reference, squared_error});
    }

  result.bias = difference / pixels;
  result.rmse = std::sqrt(squares / pixels);
  result.relative_rmse = relative_rmse(squares / pixels, radiance);
  result.relative_mse = relative_squares / pixels;
  result.psnr = result.rmse > 0.0 ? 20.0 * std::log10(largest_of(b) / result.rmse) : INFINITY;
  if (a.has_errors() || b.has_errors()) {
    result.bias_error =
        glm::sqrt(glm::dvec3(sums[0].variance(), sums[1].variance(), sums[2].variance())) / pixels;
    result.same = test_same_picture(a, b);
  }
  return result;
}

}  // namespace brume
