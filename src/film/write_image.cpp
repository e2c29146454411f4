// SPDX-License-Identifier: Apache-2.0
#include "film/write_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "film/atomic_file.h"
#include "film/srgb.h"

namespace brume {
namespace {

enum class Format { kExr, kHdr, kJpeg, kPng };

Format format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".exr") return Format::kExr;
  if (extension == ".hdr") return Format::kHdr;
  if (extension == ".jpg" || extension == ".jpeg") return Format::kJpeg;
  if (extension == ".png") return Format::kPng;
  throw Error(fmt::format("{}: {}; pictures are written as .exr, .png, .jpg, .jpeg or .hdr", path,
                          extension.empty() ? "no extension to tell the format by"
                                            : fmt::format("unknown format \"{}\"", extension)));
}

const char* oiio_name(Format format) {
  switch (format) {
    case Format::kExr:
      return "openexr";
    case Format::kHdr:
      return "hdr";
    case Format::kJpeg:
      return "jpeg";
    case Format::kPng:
      return "png";
  }
  return "";
}

std::vector<float> colours_of(const Image& image) {
  const std::size_t r = *image.channel("R"), g = *image.channel("G"), b = *image.channel("B");
  std::vector<float> colours;
  colours.reserve(std::size_t(image.width) * std::size_t(image.height) * 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      colours.insert(colours.end(), {image.at(x, y, r), image.at(x, y, g), image.at(x, y, b)});
  return colours;
}

unsigned char to_byte(float value) {
  return static_cast<unsigned char>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

/// sRGB codes of the colours, followed by the alpha channel of the image when it is `with_alpha`.
std::vector<unsigned char> to_bytes(const Image& image, float exposure, bool with_alpha) {
  const float scale = std::exp2(exposure);
  const std::vector<float> colours = colours_of(image);
  std::vector<unsigned char> bytes;
  bytes.reserve(colours.size() / 3 * (with_alpha ? 4 : 3));
  std::size_t next = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float alpha = with_alpha ? image.at(x, y, *image.channel("A")) : 1.0f;
      const float straight = alpha > 0.0f ? scale / std::min(alpha, 1.0f) : 0.0f;
      for (int c = 0; c < 3; ++c) {
        const float linear = std::clamp(straight * colours[next++], 0.0f, 1.0f);
        bytes.push_back(to_byte(srgb_from_linear(linear)));
      }
      if (with_alpha) bytes.push_back(to_byte(alpha));
    }
  }
  return bytes;
}

void add_metadata(OIIO::ImageSpec& spec, const Metadata& metadata) {
  for (const auto& [name, value] : metadata) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      spec.attribute(name, *text);
    } else if (const auto* integer = std::get_if<int>(&value)) {
      spec.attribute(name, *integer);
    } else {
      spec.attribute(name, OIIO::TypeDesc::DOUBLE, &std::get<double>(value));
    }
  }
}

/// The bytes of a file in `format`.
std::vector<unsigned char> encode(const std::string& path, Format format,
                                  const OIIO::ImageSpec& spec, const void* values) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(oiio_name(format));
  const bool encoded = output && output->set_ioproxy(&memory) && output->open(path, spec) &&
                       output->write_image(spec.format, values) && output->close();
  if (!encoded)
    throw Error(fmt::format("{}: cannot be written: {}", path,
                            output ? output->geterror() : OIIO::geterror()),
                ErrorKind::kEnvironment);
  return bytes;
}

std::vector<unsigned char> encode_linear(const std::string& path, Format format,
                                         const std::vector<float>& values, const Image& image,
                                         const std::vector<std::string>& channels,
                                         const Metadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, int(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  spec.alpha_channel = spec.channelindex("A");
  spec.z_channel = spec.channelindex("depth.Z");
  spec.attribute("compression", "zip");
  add_metadata(spec, metadata);
  return encode(path, format, spec, values.data());
}

std::vector<unsigned char> encode_srgb(const std::string& path, Format format, const Image& image,
                                       const Metadata& metadata, const ToneMapping& tone_mapping) {
  const bool with_alpha = tone_mapping.alpha && format == Format::kPng && image.channel("A");
  const std::vector<unsigned char> values = to_bytes(image, tone_mapping.exposure, with_alpha);
  OIIO::ImageSpec spec(image.width, image.height, with_alpha ? 4 : 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (format == Format::kJpeg) spec.attribute("Compression", "jpeg:95");
  add_metadata(spec, metadata);
  return encode(path, format, spec, values.data());
}

}  // namespace

void write_image(const std::string& path, const Image& image, const Metadata& metadata,
                 const ToneMapping& tone_mapping) {
  assert(image.channel("R") && image.channel("G") && image.channel("B"));
  const Format format = format_of(path);
  switch (format) {
    case Format::kExr:
      write_file_atomically(
          path, encode_linear(path, format, image.pixels, image, image.channels, metadata));
      return;
    case Format::kHdr:
      write_file_atomically(
          path, encode_linear(path, format, colours_of(image), image, {"R", "G", "B"}, metadata));
      return;
    case Format::kJpeg:
    case Format::kPng:
      write_file_atomically(path, encode_srgb(path, format, image, metadata, tone_mapping));
      return;
  }
}

std::vector<unsigned char> encode_png(const Image& image, const ToneMapping& tone_mapping) {
  return encode_srgb("picture.png", Format::kPng, image, {}, tone_mapping);
}

void check_output_path(const std::string& path) {
  format_of(path);
  check_writable(path);
}

}  // namespace brume
