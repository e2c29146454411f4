// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "film/image.h"

namespace brume {

/// What the numbers of an integer image file mean. Float files are linear always.
enum class IntegerEncoding {
  kSrgb,    // colours, decoded to linear light
  kLinear,  // data, taken as stored (0 to 1)
};

/// The picture in `path` as linear channels R, G, B, and A where the file has one (not multiplied
/// into the colours). A grey file gives three equal channels; further layers are skipped. Pixels
/// outside the file's data window are 0. Throws Error when the file cannot be read, holds no
/// colour, or holds a NaN or infinite pixel.
Image read_image(const std::string& path, IntegerEncoding encoding = IntegerEncoding::kSrgb);

/// As `read_image`, followed by the layers `stderr.R`, `.G`, `.B` (standard error of the colours)
/// where the file has all three. They may be infinite: nothing is known.
Image read_image_with_errors(const std::string& path);

}  // namespace brume
