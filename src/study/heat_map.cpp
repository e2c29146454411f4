// SPDX-License-Identifier: Apache-2.0
#include "study/heat_map.h"

#include <algorithm>
#include <cmath>

#include "study/colour_scale.h"
#include "study/comparison.h"

namespace brume {
namespace {

constexpr double kDecades = 3.0;
constexpr double kLowest = 1e-3;  // relative error

}  // namespace

double heat_position(double relative_error) {
  if (!(relative_error > kLowest)) return 0.0;
  return std::min(std::log10(relative_error / kLowest) / kDecades, 1.0);
}

std::vector<HeatMark> heat_marks() {
  return {{0.0, "0.1%"}, {1.0 / kDecades, "1%"}, {2.0 / kDecades, "10%"}, {1.0, "100%"}};
}

Image heat_map(const Image& image_a, const Image& image_b) {
  const Picture a(image_a), b(image_b);
  const double epsilon = dark_level(b);
  Image map{.width = a.width(), .height = a.height(), .channels = {"R", "G", "B"}};
  map.pixels.reserve(std::size_t(a.width()) * std::size_t(a.height()) * 3);
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const double error =
          std::sqrt(relative_squared_error(a.colour(x, y), b.colour(x, y), epsilon));
      const Rgb colour = scale_colour(heat_position(error));
      map.pixels.insert(map.pixels.end(), {colour.r, colour.g, colour.b});
    }
  return map;
}

}  // namespace brume
