// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "film/develop.h"
#include "film/film.h"
#include "film/read_image.h"
#include "film/write_image.h"

namespace brume {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A folder of its own for each test, gone afterwards.
class ImageFile : public ::testing::Test {
 protected:
  ImageFile()
      : folder_(fs::temp_directory_path() /
                ("brume-" +
                 std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
                 std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~ImageFile() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

Image gradient(int width, int height) {
  Image image{.width = width, .height = height, .channels = {"R", "G", "B", "A"}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixels.insert(image.pixels.end(), {float(x) / float(width), float(y) / float(height),
                                               1e-6f * float(x * y), 1e4f * float(x)});
  return image;
}

/// Message of the Error that `action` throws, and whether the environment is to blame.
template <typename Action>
std::pair<std::string, ErrorKind> error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return {error.what(), error.kind()};
  }
  return {"no error", ErrorKind::kInput};
}

std::string contents(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

TEST_F(ImageFile, ExrKeepsEveryLayerAndAttribute) {
  Film film(5, 3, {.albedo = true, .depth = true});
  for (std::uint32_t y = 0; y < 3; ++y)
    for (std::uint32_t x = 0; x < 5; ++x)
      for (int i = 0; i < 3; ++i)
        film.add(x, y,
                 {.L = {1e-20f * float(x), 1e20f * float(y), float(i)},
                  .alpha = 0.1f * float(x),
                  .albedo = {0.1f, 0.2f, 0.3f},
                  .depth = x == 0 ? kInfinity : float(y)});
  const Image image = develop(film);
  write_image(path("layers.exr"), image,
              {{"brume:version", "1.2"}, {"brume:samples", 3}, {"brume:seconds", 1.0 / 3.0}});

  const auto file = OIIO::ImageInput::open(path("layers.exr"));
  ASSERT_TRUE(file);
  const OIIO::ImageSpec& spec = file->spec();
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(spec["brume:version"].get<std::string>(), "1.2");
  EXPECT_EQ(spec["brume:samples"].get<int>(), 3);
  double seconds = 0.0;
  EXPECT_TRUE(spec.getattribute("brume:seconds", OIIO::TypeDesc::DOUBLE, &seconds));
  EXPECT_EQ(seconds, 1.0 / 3.0);

  ASSERT_EQ(std::size_t(spec.nchannels), image.channels.size());
  std::vector<float> values(image.pixels.size());
  ASSERT_TRUE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()));
  for (const char* name : {"R", "G", "B", "A", "stderr.R", "stderr.G", "stderr.B", "samples",
                           "albedo.R", "albedo.G", "albedo.B", "depth.Z"}) {
    ASSERT_GE(spec.channelindex(name), 0) << name;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x)
        ASSERT_EQ(values[std::size_t((y * 5 + x) * spec.nchannels + spec.channelindex(name))],
                  image.at(x, y, *image.channel(name)))
            << name;
  }
  EXPECT_EQ(image.at(0, 0, *image.channel("depth.Z")), kInfinity);
  EXPECT_EQ(image.at(1, 2, *image.channel("depth.Z")), 2.0f);
  EXPECT_EQ(image.at(1, 2, *image.channel("samples")), 3.0f);
}

TEST_F(ImageFile, ExrComesBackAsItWasWritten) {
  const Image image = gradient(70, 40);
  write_image(path("a.exr"), image);
  const Image back = read_image(path("a.exr"));
  EXPECT_EQ(back.width, 70);
  EXPECT_EQ(back.height, 40);
  EXPECT_EQ(back.channels, image.channels);
  EXPECT_EQ(back.pixels, image.pixels);
}

TEST_F(ImageFile, HdrKeepsRadianceAboveOne) {
  Image image{.width = 2, .height = 1, .channels = {"R", "G", "B"}};
  image.pixels = {1000.0f, 500.0f, 250.0f, 0.25f, 0.5f, 0.125f};
  write_image(path("a.hdr"), image);
  const Image back = read_image(path("a.hdr"));
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(back.pixels[i] / image.pixels[i], 1.0f, 0.01f) << i;
}

/// Bytes of the first pixel of a PNG or JPEG.
std::vector<int> first_pixel(const std::string& path) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto file = OIIO::ImageInput::open(path, &config);
  const auto channels = std::size_t(file->spec().nchannels);
  std::vector<unsigned char> values(file->spec().image_pixels() * channels);
  file->read_image(0, 0, 0, int(channels), OIIO::TypeDesc::UINT8, values.data());
  return {values.begin(), values.begin() + std::ptrdiff_t(channels)};
}

TEST_F(ImageFile, PngHoldsSrgbCodes) {
  Image image{.width = 1, .height = 1, .channels = {"R", "G", "B", "A"}};
  image.pixels = {0.2158605f, 2.0f, 0.001f, 0.5f};
  write_image(path("a.png"), image);
  EXPECT_EQ(first_pixel(path("a.png")), (std::vector{128, 255, 3}));
  write_image(path("a.png"), image, {}, {.exposure = -1.0f});
  EXPECT_EQ(first_pixel(path("a.png")), (std::vector{92, 255, 2}));
  write_image(path("a.png"), image, {}, {.alpha = true});
  EXPECT_EQ(first_pixel(path("a.png")), (std::vector{176, 255, 7, 128}));
  write_image(path("a.JPEG"), image);
  EXPECT_NEAR(first_pixel(path("a.JPEG"))[0], 128, 3);
}

TEST_F(ImageFile, EightBitColoursAreDecodedOnRequest) {
  Image image{.width = 1, .height = 1, .channels = {"R", "G", "B"}};
  image.pixels = {0.2158605f, 1.0f, 0.0f};
  write_image(path("a.png"), image);
  EXPECT_NEAR(read_image(path("a.png")).pixels[0], 0.2158605f, 1e-6f);  // of code 128
  EXPECT_EQ(read_image(path("a.png")).pixels[1], 1.0f);
  EXPECT_FLOAT_EQ(read_image(path("a.png"), IntegerEncoding::kLinear).pixels[0], 128.0f / 255.0f);
}

TEST_F(ImageFile, GreyPicturesHaveThreeEqualChannels) {
  OIIO::ImageSpec spec(2, 1, 1, OIIO::TypeDesc::UINT8);
  const auto file = OIIO::ImageOutput::create("png");
  ASSERT_TRUE(file->open(path("grey.png"), spec));
  const unsigned char values[] = {255, 0};
  ASSERT_TRUE(file->write_image(spec.format, values) && file->close());
  const Image image = read_image(path("grey.png"));
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(image.pixels, (std::vector{1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f}));
}

TEST_F(ImageFile, CroppedDataWindowIsPutInItsPlace) {
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::FLOAT);
  spec.x = 2;
  spec.y = 1;
  spec.full_width = 4;
  spec.full_height = 2;
  const auto file = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(file->open(path("crop.exr"), spec));
  const float values[] = {1.0f, 2.0f, 3.0f};
  ASSERT_TRUE(file->write_image(spec.format, values) && file->close());
  const Image image = read_image(path("crop.exr"));
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(2, 1, 2), 3.0f);
  EXPECT_EQ(image.at(1, 1, 2), 0.0f);
}

TEST_F(ImageFile, ReadingNamesTheFileAndWhatWasFound) {
  const auto missing = error_of([&] { read_image(path("none.exr")); });
  EXPECT_THAT(missing.first, HasSubstr(path("none.exr") + ": no such file"));
  EXPECT_EQ(missing.second, ErrorKind::kInput);

  std::ofstream(path("text.png")) << "not a picture";
  const auto damaged = error_of([&] { read_image(path("text.png")); });
  EXPECT_THAT(damaged.first, HasSubstr(path("text.png")));
  EXPECT_EQ(damaged.second, ErrorKind::kInput);

  std::ofstream(path("huge.pgm")) << "P5\n200000 200000\n255\n";
  EXPECT_THAT(error_of([&] { read_image(path("huge.pgm")); }).first,
              AllOf(HasSubstr(path("huge.pgm")), HasSubstr("200000 x 200000 pixels")));

  write_image(path("cut.exr"), gradient(64, 64));
  fs::resize_file(path("cut.exr"), fs::file_size(path("cut.exr")) / 2);
  EXPECT_THAT(error_of([&] { read_image(path("cut.exr")); }).first, HasSubstr(path("cut.exr")));

  Image nan = gradient(4, 4);
  nan.at(1, 2, 1) = NAN;
  nan.at(3, 3, 0) = kInfinity;
  write_image(path("nan.exr"), nan);
  EXPECT_THAT(error_of([&] { read_image(path("nan.exr")); }).first,
              AllOf(HasSubstr("2 values"), HasSubstr("(1, 2), channel G")));

  OIIO::ImageSpec spec(1, 1, 2, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"velocity.X", "velocity.Y"};
  const auto file = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(file->open(path("velocity.exr"), spec));
  const float values[] = {1.0f, 2.0f};
  ASSERT_TRUE(file->write_image(spec.format, values) && file->close());
  EXPECT_THAT(error_of([&] { read_image(path("velocity.exr")); }).first,
              HasSubstr("velocity.X, velocity.Y"));
}

TEST_F(ImageFile, OutputPathsAreRefusedBeforeRendering) {
  EXPECT_NO_THROW(check_output_path(path("a.exr")));
  EXPECT_NO_THROW(check_output_path("relative.PNG"));
  const auto extension = error_of([&] { check_output_path(path("a.tiff")); });
  EXPECT_THAT(extension.first, AllOf(HasSubstr("\".tiff\""), HasSubstr(".exr, .png")));
  EXPECT_EQ(extension.second, ErrorKind::kInput);
  EXPECT_THAT(error_of([&] { check_output_path(path("a")); }).first, HasSubstr("no extension"));
  const auto folder = error_of([&] { check_output_path(path("none/a.exr")); });
  EXPECT_THAT(folder.first, HasSubstr("there is no folder " + path("none")));
  EXPECT_EQ(folder.second, ErrorKind::kEnvironment);
  std::ofstream(path("file")) << "x";
  EXPECT_THAT(error_of([&] { check_output_path(path("file/a.exr")); }).first,
              HasSubstr("is not a folder"));
  fs::create_directory(path("folder.exr"));
  EXPECT_THAT(error_of([&] { check_output_path(path("folder.exr")); }).first,
              HasSubstr("it is a folder"));
}

TEST_F(ImageFile, NothingButThePictureIsLeftBehind) {
  write_image(path("a.exr"), gradient(8, 8));
  write_image(path("a.exr"), gradient(9, 9));
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(read_image(path("a.exr")).width, 9);
}

TEST_F(ImageFile, LinkIsKeptAndItsFileReplaced) {
  write_image(path("real.exr"), gradient(8, 8));
  fs::create_symlink("real.exr", folder_ / "link.exr");
  write_image(path("link.exr"), gradient(9, 9));
  EXPECT_TRUE(fs::is_symlink(path("link.exr")));
  EXPECT_EQ(read_image(path("real.exr")).width, 9);
}

TEST_F(ImageFile, OlderPictureSurvivesADiskThatFillsUp) {
  write_image(path("a.exr"), gradient(8, 8));
  const std::string before = contents(path("a.exr"));

  rlimit unlimited{};
  getrlimit(RLIMIT_FSIZE, &unlimited);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 4096, .rlim_max = unlimited.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto error = error_of([&] { write_image(path("a.exr"), gradient(200, 200)); });
  setrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_THAT(error.first, AllOf(HasSubstr(path("a.exr")), HasSubstr("File too large")));
  EXPECT_EQ(error.second, ErrorKind::kEnvironment);
  EXPECT_EQ(contents(path("a.exr")), before);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, OlderPictureSurvivesAFolderThatMayNotBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  write_image(path("a.exr"), gradient(8, 8));
  const std::string before = contents(path("a.exr"));
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  const auto error = error_of([&] { write_image(path("a.exr"), gradient(9, 9)); });
  EXPECT_THAT(error.first, AllOf(HasSubstr(path("a.exr")), HasSubstr("Permission denied")));
  EXPECT_THAT(error_of([&] { check_output_path(path("b.exr")); }).first,
              HasSubstr("Permission denied"));
  EXPECT_EQ(contents(path("a.exr")), before);
}

}  // namespace
}  // namespace brume
