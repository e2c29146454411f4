// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_fixture.h"

namespace brume::test {
namespace {

using ::testing::HasSubstr;

class Compare : public CliTest {
 protected:
  void render(const std::string& name, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"render", "scene.xml", "--quiet", "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run(arguments).exit_code, 0);
  }
};

TEST_F(Compare, TwoSeedsShowTheSamePictureAndAnotherSceneDoesNot) {
  render("a.exr", {"--spp", "128", "--seed", "1"});
  render("b.exr", {"--spp", "128", "--seed", "2"});
  render("brighter.exr", {"--spp", "128", "--seed", "3", "-D", "glow=1.1"});

  const Ended same = run({"compare", "a.exr", "b.exr", "--json", "same.json"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  for (const char* word : {"bias", "+-", "RMSE", "relative RMSE", "relative MSE", "PSNR",
                           "worst pixels", "z-scores", "same picture"})
    EXPECT_THAT(same.out, HasSubstr(word));
  EXPECT_GT(json("same.json")["same_picture"]["p"].get<double>(), 0.01);

  EXPECT_EQ(run({"compare", "a.exr", "brighter.exr", "--json", "not.json"}).exit_code, 0);
  EXPECT_LT(json("not.json")["same_picture"]["p"].get<double>(), 1e-4);
  EXPECT_NEAR(json("not.json")["bias"][1].get<double>(), -0.1, 0.03);
}

TEST_F(Compare, EveryFormatAndAHeatMapOfEach) {
  render("reference.exr", {"--spp", "16"});
  for (const std::string extension : {".exr", ".png", ".jpg", ".hdr"}) {
    render("a" + extension, {"--spp", "4", "--seed", "2"});
    const Ended ended = run({"compare", "a" + extension, "reference.exr", "-o", "map" + extension});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(exists("map" + extension));
  }
}

TEST_F(Compare, WithoutErrorLayersNothingIsSaidOfChance) {
  render("a.png", {});
  const Ended ended = run({"compare", "a.png", "a.png"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, ::testing::Not(HasSubstr("same picture")));
}

TEST_F(Compare, PicturesThatCannotBeComparedAreRefused) {
  render("a.exr", {});
  render("small.exr", {"--size", "8x6"});
  write("text.exr", "no picture");
  expect_refusal({"compare", "a.exr", "small.exr"}, 2,
                 "brume: pictures of different sizes cannot be compared: 16 x 12 and 8 x 6\n");
  expect_refusal({"compare", "a.exr", "none.exr"}, 2, "brume: none.exr: no such file\n");
  const Ended damaged = run({"compare", "a.exr", "text.exr"});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("text.exr"));
  const Ended format = run({"compare", "a.exr", "a.exr", "-o", "map.tiff"});
  EXPECT_EQ(format.exit_code, 2);
  EXPECT_THAT(format.err, HasSubstr("map.tiff"));
  expect_refusal({"compare", "a.exr"}, 2, "brume: B is required\nTry: brume compare --help\n");
}

}  // namespace
}  // namespace brume::test
