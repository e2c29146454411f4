// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "material/texture.h"

namespace brume {

/// An image stretched over the unit square of uv. As in Mitsuba v = 0 is its first row, the top:
/// nothing is flipped here, meshes whose v points up are flipped as they are read.
class BitmapTexture final : public Texture {
 public:
  enum class Filter { kBilinear, kNearest };
  enum class Wrap { kRepeat, kMirror, kClamp };

  /// `pixels` are linear, row by row from the top, width * height of them and at least one.
  /// `to_uv` is applied to (u, v, 1).
  BitmapTexture(std::vector<Rgb> pixels, int width, int height, Filter filter, Wrap wrap,
                const glm::mat3& to_uv);

  Rgb value(const Vec2& uv) const override;

 private:
  const Rgb& pixel(int x, int y) const;
  int wrap_index(int i, int size) const;

  std::vector<Rgb> pixels_;  // [height][width]
  int width_, height_;
  Filter filter_;
  Wrap wrap_;
  glm::mat3 to_uv_;
};

}  // namespace brume
