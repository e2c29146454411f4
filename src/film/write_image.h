// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "film/image.h"

namespace brume {

/// Attributes stored in the file's header, where the format has room for them.
using Metadata = std::vector<std::pair<std::string, std::variant<std::string, int, double>>>;

/// How radiance becomes an 8-bit picture; EXR and HDR files keep radiance as it is.
struct ToneMapping {
  float exposure = 0.0f;  // [stops], each doubles the brightness
  bool alpha = false;     // PNG only: write A, colours divided by it; otherwise opaque
};

/// Writes `image`, which has R, G and B, in the format of the extension of `path`: .exr (every
/// channel, float32, linear Rec. 709), .hdr (linear colours), .png and .jpg (sRGB). An older file
/// is replaced whole or not at all. Throws Error naming the path and the reason.
void write_image(const std::string& path, const Image& image, const Metadata& metadata = {},
                 const ToneMapping& tone_mapping = {});

/// The bytes of a .png file of `image`.
std::vector<unsigned char> encode_png(const Image& image, const ToneMapping& tone_mapping = {});

/// Throws Error when `write_image` could not write `path`: the extension is unknown, or the folder
/// missing or not writable. To be called before hours of rendering.
void check_output_path(const std::string& path);

}  // namespace brume
