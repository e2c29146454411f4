// SPDX-License-Identifier: Apache-2.0
#include "study/accuracy.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "integrator/path_settings.h"
#include "study/picture.h"

namespace brume {
namespace {

/// Mean over pixels, with an interval from their spread, or from that of groups of pixels that may
/// share light paths if it is wider.
class PixelMean {
 public:
  void add(int x, int y, double value) {
    Group& group = groups_[std::size_t(y % kPeriod * kPeriod + x % kPeriod)];
    group.sum += value;
    group.pixels += 1.0;
    const double deviation = value - mean_;  // Welford 1962
    n_ += 1.0;
    mean_ += deviation / n_;
    squares_ += deviation * (value - mean_);
  }
  Estimate scaled_by(double scale) const {
    constexpr double kTwoSided95 = 1.95996;  // quantile of the normal distribution
    const double of_pixels = n_ > 1.0 ? squares_ / (n_ * (n_ - 1.0)) : INFINITY;
    double squares = 0.0, shares_squared = 0.0;
    for (const Group& group : groups_) {
      const double rest = (group.sum - group.pixels * mean_) / n_;
      squares += rest * rest;
      shares_squared += group.pixels * group.pixels / (n_ * n_);
    }
    const double of_groups = shares_squared < 1.0 ? squares / (1.0 - shares_squared) : 0.0;
    return {scale * mean_, kTwoSided95 * scale * std::sqrt(std::max(of_pixels, of_groups))};
  }

 private:
  static constexpr int kPeriod = kLightPathSpacing;  // [pixel]
  struct Group {
    double sum = 0.0, pixels = 0.0;
  };
  std::array<Group, kPeriod * kPeriod> groups_{};
  double n_ = 0.0, mean_ = 0.0, squares_ = 0.0;
};

double mean_radiance(const Picture& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) sum += average(picture.colour(x, y));
  return sum / (double(picture.width()) * picture.height());
}

}  // namespace

Reference reference_of_halves(Image first, Image second) {
  assert(first.width == second.width && first.height == second.height);
  const double radiance = 0.5 * (mean_radiance(Picture(first)) + mean_radiance(Picture(second)));
  return {.first = std::move(first), .second = std::move(second), .radiance = radiance};
}

Reference reference_of_picture(const Image& image) {
  const Picture picture(image);
  Reference reference{.first = image, .second = image, .radiance = mean_radiance(picture)};
  if (!picture.has_errors()) return reference;
  reference.variance = {.width = image.width, .height = image.height, .channels = {"R", "G", "B"}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 v = picture.variance(x, y);
      reference.variance.pixels.insert(reference.variance.pixels.end(),
                                       {float(v.r), float(v.g), float(v.b)});
    }
  return reference;
}

Image best_picture(const Reference& reference) {
  const Picture first(reference.first), second(reference.second);
  Image mean{.width = first.width(), .height = first.height(), .channels = {"R", "G", "B"}};
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x) {
      const glm::dvec3 c = 0.5 * (first.colour(x, y) + second.colour(x, y));
      mean.pixels.insert(mean.pixels.end(), {float(c.r), float(c.g), float(c.b)});
    }
  return mean;
}

Accuracy measure_accuracy(std::span<const Image> pictures, const Reference& reference) {
  assert(pictures.size() >= 2);
  const std::vector<Picture> seeds(pictures.begin(), pictures.end());
  const Picture first(reference.first), second(reference.second);
  const double n = double(seeds.size());

  PixelMean error, bias, mean;
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x) {
      glm::dvec3 sum_first(0.0), sum_second(0.0), products(0.0), variance(0.0);
      for (const Picture& seed : seeds) {
        const glm::dvec3 from_first = seed.colour(x, y) - first.colour(x, y);
        const glm::dvec3 from_second = seed.colour(x, y) - second.colour(x, y);
        sum_first += from_first;
        sum_second += from_second;
        products += from_first * from_second;
      }
      if (!reference.variance.pixels.empty()) variance = Picture(reference.variance).colour(x, y);
      // Products of one picture's two differences hold its noise; those of two pictures do not.
      error.add(x, y, average(products / n - variance));
      bias.add(x, y, average((sum_first * sum_second - products) / (n * (n - 1.0)) - variance));
      mean.add(x, y, average(0.5 * (sum_first + sum_second) / n));
    }

  const double unit = 1.0 / (reference.radiance * reference.radiance);
  Accuracy result{.squared_error = error.scaled_by(unit),
                  .squared_bias = bias.scaled_by(unit),
                  .mean_bias = mean.scaled_by(1.0 / reference.radiance)};
  result.variance = std::max(result.squared_error.value - result.squared_bias.value, 0.0);
  return result;
}

RootInterval root(const Estimate& square) {
  const auto root_or_zero = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  // An estimate below 0 is 0 with bad luck: its upper end is no lower than that of 0.
  const double value = std::max(square.value, 0.0);
  return {.value = std::sqrt(value),
          .low = root_or_zero(square.value - square.error),
          .high = std::sqrt(value + square.error)};
}

}  // namespace brume
