// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "film/image.h"

namespace brume {

/// Colours of an image, and their standard errors where it has them, in double.
class Picture {
 public:
  /// `image` has R, G and B and outlives this.
  explicit Picture(const Image& image) : image_(image), colour_(positions("R", "G", "B")) {
    if (image.channel("stderr.R")) error_ = positions("stderr.R", "stderr.G", "stderr.B");
  }

  int width() const { return image_.width; }
  int height() const { return image_.height; }
  bool has_errors() const { return error_.has_value(); }

  glm::dvec3 colour(int x, int y) const { return at(x, y, colour_); }
  /// Variance of `colour`; infinite where nothing is known, 0 without error layers.
  glm::dvec3 variance(int x, int y) const {
    if (!error_) return glm::dvec3(0.0);
    const glm::dvec3 error = at(x, y, *error_);
    return error * error;
  }

 private:
  using Positions = glm::vec<3, std::size_t>;

  Positions positions(const char* r, const char* g, const char* b) const {
    return {*image_.channel(r), *image_.channel(g), *image_.channel(b)};
  }
  glm::dvec3 at(int x, int y, const Positions& i) const {
    return {image_.at(x, y, i.x), image_.at(x, y, i.y), image_.at(x, y, i.z)};
  }

  const Image& image_;
  Positions colour_;
  std::optional<Positions> error_{};
};

/// Mean over the channels.
inline double average(const glm::dvec3& v) {
  return (v.x + v.y + v.z) / 3.0;
}

}  // namespace brume
