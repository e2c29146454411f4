// SPDX-License-Identifier: Apache-2.0
#include "film/read_image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/error.h"
#include "film/srgb.h"

namespace brume {
namespace {

/// The library's own words, which may come in several lines, in one.
std::string one_line(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

std::optional<std::size_t> find_channel(const OIIO::ImageSpec& spec, std::string_view name) {
  const int index = spec.channelindex(OIIO::string_view(name.data(), name.size()));
  if (index < 0) return std::nullopt;
  return std::size_t(index);
}

/// Positions of R, G, B and A in the file; three positions when it has no A.
std::vector<std::size_t> colour_channels(const OIIO::ImageSpec& spec, const std::string& path) {
  std::vector<std::size_t> positions;
  for (const char* name : {"R", "G", "B"})
    if (const auto position = find_channel(spec, name)) positions.push_back(*position);
  if (positions.size() != 3) {
    const auto grey = spec.nchannels == 1 ? std::size_t{0} : find_channel(spec, "Y");
    if (!grey)
      throw Error(fmt::format("{}: no colour in this picture: found channels {}, expected R, G, B",
                              path, fmt::join(spec.channelnames, ", ")));
    positions.assign(3, *grey);
  }
  if (const auto alpha = find_channel(spec, "A")) positions.push_back(*alpha);
  return positions;
}

/// The first `channels` of the image hold no NaN and no infinity.
void require_finite(const Image& image, std::size_t channels, const std::string& path) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % image.channels.size() >= channels || std::isfinite(image.pixels[i])) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  const std::size_t pixel = first / image.channels.size();
  throw Error(
      fmt::format("{}: {} values are NaN or infinite, the first in pixel ({}, {}), channel {}",
                  path, count, pixel % std::size_t(image.width), pixel / std::size_t(image.width),
                  image.channels[first % image.channels.size()]));
}

constexpr const char* kErrorLayers[] = {"stderr.R", "stderr.G", "stderr.B"};

/// Headers of damaged files claim sizes that no memory could hold.
void require_sensible_size(int width, int height, const std::string& path) {
  constexpr std::int64_t kMaxPixels = std::int64_t(1) << 30;
  if (width > 0 && height > 0 && std::int64_t(width) * height <= kMaxPixels) return;
  throw Error(fmt::format("{}: a picture of {} x {} pixels; expected 1 to {} in all", path, width,
                          height, kMaxPixels));
}

/// Positions of the error layers in the file; none unless all are there.
std::vector<std::size_t> error_channels(const OIIO::ImageSpec& spec) {
  std::vector<std::size_t> positions;
  for (const char* name : kErrorLayers)
    if (const auto position = find_channel(spec, name)) positions.push_back(*position);
  if (positions.size() != std::size(kErrorLayers)) positions.clear();
  return positions;
}

Image read(const std::string& path, IntegerEncoding encoding, bool with_errors) {
  if (!std::filesystem::exists(path)) throw Error(fmt::format("{}: no such file", path));

  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto file = OIIO::ImageInput::open(path, &config);
  if (!file)
    throw Error(
        fmt::format("{}: cannot be read as a picture: {}", path, one_line(OIIO::geterror())));

  const OIIO::ImageSpec& spec = file->spec();
  require_sensible_size(spec.width, spec.height, path);
  require_sensible_size(spec.full_width, spec.full_height, path);
  std::vector<std::size_t> source = colour_channels(spec, path);
  const std::size_t colours = source.size();
  const std::vector<std::size_t> errors =
      with_errors ? error_channels(spec) : std::vector<std::size_t>{};
  source.insert(source.end(), errors.begin(), errors.end());
  const auto file_channels = std::size_t(spec.nchannels);
  std::vector<float> values(std::size_t(spec.width) * std::size_t(spec.height) * file_channels);
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw Error(fmt::format("{}: damaged picture: {}", path, one_line(file->geterror())));

  Image image{.width = spec.full_width, .height = spec.full_height, .channels = {"R", "G", "B"}};
  if (colours == 4) image.channels.push_back("A");
  if (!errors.empty())
    image.channels.insert(image.channels.end(), std::begin(kErrorLayers), std::end(kErrorLayers));
  image.pixels.assign(std::size_t(image.width) * std::size_t(image.height) * source.size(), 0.0f);

  const bool decode = encoding == IntegerEncoding::kSrgb && !spec.format.is_floating_point();
  for (int y = 0; y < spec.height; ++y) {
    const int to_y = y + spec.y - spec.full_y;
    if (to_y < 0 || to_y >= image.height) continue;
    for (int x = 0; x < spec.width; ++x) {
      const int to_x = x + spec.x - spec.full_x;
      if (to_x < 0 || to_x >= image.width) continue;
      const auto pixel = std::size_t(y) * std::size_t(spec.width) + std::size_t(x);
      for (std::size_t c = 0; c < source.size(); ++c) {
        const float value = values[pixel * file_channels + source[c]];
        image.at(to_x, to_y, c) = decode && c < 3 ? linear_from_srgb(value) : value;
      }
    }
  }
  require_finite(image, colours, path);
  return image;
}

}  // namespace

Image read_image(const std::string& path, IntegerEncoding encoding) {
  return read(path, encoding, false);
}

Image read_image_with_errors(const std::string& path) {
  return read(path, IntegerEncoding::kSrgb, true);
}

}  // namespace brume
