// SPDX-License-Identifier: Apache-2.0
#include "material/bitmap_texture.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace brume {

namespace {

/// The same place in the unit interval, or its period of two for mirroring, so that pixel indices
/// stay small however far away the coordinate is.
float wrap_coordinate(float x, BitmapTexture::Wrap wrap) {
  switch (wrap) {
    case BitmapTexture::Wrap::kRepeat:
      return x - std::floor(x);
    case BitmapTexture::Wrap::kMirror:
      return x - 2.0f * std::floor(0.5f * x);
    case BitmapTexture::Wrap::kClamp:
      break;
  }
  return std::clamp(x, 0.0f, 1.0f);
}

}  // namespace

BitmapTexture::BitmapTexture(std::vector<Rgb> pixels, int width, int height, Filter filter,
                             Wrap wrap, const glm::mat3& to_uv)
    : pixels_(std::move(pixels)),
      width_(width),
      height_(height),
      filter_(filter),
      wrap_(wrap),
      to_uv_(to_uv) {
  assert(width > 0 && height > 0 && pixels_.size() == std::size_t(width) * std::size_t(height));
}

int BitmapTexture::wrap_index(int i, int size) const {
  switch (wrap_) {
    case Wrap::kRepeat:
      return ((i % size) + size) % size;
    case Wrap::kMirror: {
      const int period = 2 * size;
      const int j = ((i % period) + period) % period;
      return j < size ? j : period - 1 - j;
    }
    case Wrap::kClamp:
      break;
  }
  return std::clamp(i, 0, size - 1);
}

const Rgb& BitmapTexture::pixel(int x, int y) const {
  return pixels_[std::size_t(wrap_index(y, height_)) * std::size_t(width_) +
                 std::size_t(wrap_index(x, width_))];
}

Rgb BitmapTexture::value(const Vec2& uv) const {
  const Vec2 p(to_uv_ * Vec3(uv, 1.0f));
  const Vec2 xy =
      Vec2(wrap_coordinate(p.x, wrap_), wrap_coordinate(p.y, wrap_)) * Vec2(width_, height_);
  if (filter_ == Filter::kNearest) {
    return pixel(int(std::floor(xy.x)), int(std::floor(xy.y)));
  }
  const Vec2 corner = xy - 0.5f;  // pixels are centred on their samples
  const Vec2 low = glm::floor(corner);
  const Vec2 f = corner - low;
  const int x = int(low.x), y = int(low.y);
  return glm::mix(glm::mix(pixel(x, y), pixel(x + 1, y), f.x),
                  glm::mix(pixel(x, y + 1), pixel(x + 1, y + 1), f.x), f.y);
}

}  // namespace brume
