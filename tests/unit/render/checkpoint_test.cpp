// SPDX-License-Identifier: Apache-2.0
#include "render/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "film/film.h"
#include "support/temporary_folder.h"

namespace brume {
namespace {

using ::testing::HasSubstr;

class CheckpointTest : public ::testing::Test {
 protected:
  std::string path() const { return (folder_.path() / "a.checkpoint").string(); }
  std::string bytes() const {
    std::ifstream file(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// What is said when `film` is continued from `bytes`; empty when nothing is wrong with them.
  std::string complaint(const std::string& bytes, const Fingerprint& fingerprint) const {
    folder_.write("a.checkpoint", bytes);
    Film film(kWidth, kHeight, kLayers);
    try {
      read_checkpoint(path(), fingerprint, film);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return {};
  }

  static void expose(Film& film, std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        for (std::uint32_t i = first; i < end; ++i)
          film.add(x, y,
                   {.L = x == 2 && i == 5 ? Rgb(std::nanf("")) : Rgb(float(x + y * i % 7)),
                    .albedo = Rgb(0.25f * float(i % 3)),
                    .depth = float(i)});
  }

  static constexpr std::uint32_t kWidth = 3, kHeight = 2;
  static constexpr FilmLayers kLayers{.albedo = true, .depth = true, .guide = true};
  const Fingerprint fingerprint_{{"--seed", "7"}, {"content of a.xml", "12 bytes"}};

 private:
  test::TemporaryFolder folder_;
};

TEST_F(CheckpointTest, AFilmGoesOnAsIfNothingHadBeen) {
  Film whole(kWidth, kHeight, kLayers), first(kWidth, kHeight, kLayers);
  expose(whole, 0, 100);
  expose(first, 0, 41);
  write_checkpoint(path(), fingerprint_, {.blocks = 3, .seconds = 1.5}, first);
  Film second(kWidth, kHeight, kLayers);
  const RenderState state = read_checkpoint(path(), fingerprint_, second);
  EXPECT_EQ(state.blocks, 3u);
  EXPECT_EQ(state.seconds, 1.5);
  EXPECT_EQ(second.drawn(2, 1), 41u);
  EXPECT_EQ(second.samples(2, 1), 40u);
  expose(second, 41, 100);
  const auto wanted = whole.pixel_bytes(), got = second.pixel_bytes();
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_EQ(std::memcmp(got[i].data(), wanted[i].data(), wanted[i].size()), 0) << i;
  EXPECT_EQ(second.bad_samples()->count, whole.bad_samples()->count);
  EXPECT_EQ(second.bad_samples()->x, 2u);
}

TEST_F(CheckpointTest, AnotherRenderIsRefusedWithWhatDiffers) {
  Film film(kWidth, kHeight, kLayers);
  write_checkpoint(path(), fingerprint_, {}, film);
  const std::string message =
      complaint(bytes(), {{"--seed", "8"}, {"content of a.xml", "12 bytes"}, {"-D glow", "3"}});
  EXPECT_THAT(message, HasSubstr("a.checkpoint belongs to another render:\n"
                                 "  --seed: 7 there, 8 here\n"
                                 "  -D glow: none there, 3 here\n"));
  EXPECT_THAT(complaint(bytes(), {{"--seed", "7"}}),
              HasSubstr("content of a.xml: 12 bytes there, none here"));
}

TEST_F(CheckpointTest, NoDamageGoesUnnoticed) {
  Film film(kWidth, kHeight, kLayers);
  expose(film, 0, 20);
  write_checkpoint(path(), fingerprint_, {.blocks = 2}, film);
  const std::string whole = bytes();
  EXPECT_EQ(complaint(whole, fingerprint_), "");
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 20)
    EXPECT_THAT(complaint(whole.substr(0, length), fingerprint_), HasSubstr("ends too early"));
  for (std::size_t i = 0; i < whole.size(); i += 1 + i / 50) {
    std::string damaged = whole;
    damaged[i] = char(damaged[i] ^ 0x10);
    EXPECT_THAT(complaint(damaged, fingerprint_), HasSubstr("a.checkpoint")) << i;
  }
  EXPECT_THAT(complaint(whole + "x", fingerprint_), HasSubstr("something follows its end"));
  EXPECT_THAT(complaint("this was written by something else", fingerprint_),
              HasSubstr("is no checkpoint of brume"));
}

}  // namespace
}  // namespace brume
