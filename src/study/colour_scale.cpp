// SPDX-License-Identifier: Apache-2.0
#include "study/colour_scale.h"

#include <algorithm>

namespace brume {
namespace {

/// Oklab lightness and opponent colours to linear Rec. 709 (Ottosson 2020).
Rgb from_oklab(double lightness, double green_red, double blue_yellow) {
  const auto cubed = [](double v) { return v * v * v; };
  const double l = cubed(lightness + 0.3963377774 * green_red + 0.2158037573 * blue_yellow);
  const double m = cubed(lightness - 0.1055613458 * green_red - 0.0638541728 * blue_yellow);
  const double s = cubed(lightness - 0.0894841775 * green_red - 1.2914855480 * blue_yellow);
  return {float(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          float(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          float(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Rgb scale_colour(double u) {
  u = std::clamp(u, 0.0, 1.0);
  const double lightness = 0.22 + 0.73 * u;
  const Rgb colour = from_oklab(lightness, -0.012 - 0.03 * u * u, -0.115 + 0.27 * u);
  return glm::clamp(colour, Rgb{0.0f}, Rgb{1.0f});
}

}  // namespace brume
