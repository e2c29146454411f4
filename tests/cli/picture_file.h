// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <string>
#include <vector>

namespace brume::test {

/// Every channel of a picture file as it is stored.
struct PictureFile {
  int width = 0, height = 0;
  std::vector<std::string> channels{};
  std::vector<float> pixels{};
  OIIO::ImageSpec spec{};
};

/// Fails the test where there is no picture, and returns an empty one.
PictureFile read_picture(const std::filesystem::path& path);

/// Whether both hold the same channels and bits, and any at all.
bool same_bits(const PictureFile& a, const PictureFile& b);

}  // namespace brume::test
