// SPDX-License-Identifier: Apache-2.0
#include "film/develop.h"

#include "film/film.h"

namespace brume {

Image develop(const Film& film) {
  Image image{.width = int(film.width()), .height = int(film.height())};
  image.channels = {"R", "G", "B", "A", "stderr.R", "stderr.G", "stderr.B", "samples"};
  if (film.layers().albedo)
    image.channels.insert(image.channels.end(), {"albedo.R", "albedo.G", "albedo.B"});
  if (film.layers().depth) image.channels.push_back("depth.Z");

  image.pixels.reserve(std::size_t(film.width()) * film.height() * image.channels.size());
  const auto append = [&image](const Rgb& c) {
    image.pixels.insert(image.pixels.end(), {c.r, c.g, c.b});
  };
  for (std::uint32_t y = 0; y < film.height(); ++y) {
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      append(film.mean(x, y));
      image.pixels.push_back(film.alpha(x, y));
      append(film.standard_error(x, y));
      image.pixels.push_back(static_cast<float>(film.samples(x, y)));
      if (film.layers().albedo) append(film.albedo(x, y));
      if (film.layers().depth) image.pixels.push_back(film.depth(x, y));
    }
  }
  return image;
}

}  // namespace brume
