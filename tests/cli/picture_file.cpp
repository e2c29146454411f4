// SPDX-License-Identifier: Apache-2.0
#include "cli/picture_file.h"

#include <gtest/gtest.h>

#include <cstring>

namespace brume::test {

PictureFile read_picture(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    ADD_FAILURE() << OIIO::geterror();
    return {};
  }
  const OIIO::ImageSpec& spec = input->spec();
  PictureFile picture{spec.width, spec.height, spec.channelnames, {}, spec};
  picture.pixels.resize(std::size_t(spec.width) * spec.height * spec.nchannels);
  EXPECT_TRUE(
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.pixels.data()));
  return picture;
}

bool same_bits(const PictureFile& a, const PictureFile& b) {
  return a.channels == b.channels && a.pixels.size() == b.pixels.size() && !a.pixels.empty() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

}  // namespace brume::test
