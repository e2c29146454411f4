// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "core/rgb.h"
#include "core/rng.h"
#include "film/image.h"

namespace brume::test {

/// A picture of R, G and B with `colour(x, y)` in pixel (x, y).
inline Image picture(int width, int height, const std::function<Rgb(int, int)>& colour) {
  Image image{.width = width, .height = height, .channels = {"R", "G", "B"}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb c = colour(x, y);
      image.pixels.insert(image.pixels.end(), {c.r, c.g, c.b});
    }
  return image;
}

}  // namespace brume::test
