// SPDX-License-Identifier: Apache-2.0
#include <csignal>

#include "cli/cli_fixture.h"
#include "support/constant_vdb.h"
#include "support/scene_files.h"

namespace brume::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class RenderCommand : public CliTest {
 protected:
  /// A scene that takes far longer than any test.
  void write_long_scene() const {
    std::string text = kScene;
    text.replace(text.find("value=\"4\""), 9, "value=\"1000000000\"");
    write("long.xml", text);
  }
};

TEST_F(RenderCommand, WritesAnExrNamedAfterTheInputInTheCurrentFolder) {
  std::filesystem::create_directory(path("elsewhere"));
  std::filesystem::rename(path("scene.xml"), path("elsewhere/scene.xml"));
  const Ended ended = run({"render", "elsewhere/scene.xml"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, MatchesRegex("scene.exr \\(16x12\\): 4 samples a pixel in .* s, sample "
                                      "count reached; relative RMS error .*%, below .*% with 95% "
                                      "confidence\n"));
  const PictureFile picture = read("scene.exr");
  EXPECT_EQ(picture.width, 16);
  EXPECT_EQ(picture.height, 12);
  EXPECT_THAT(picture.channels, ::testing::IsSupersetOf({"R", "G", "B", "A"}));
  EXPECT_EQ(picture.spec.get_int_attribute("brume:max_depth", -7), -1);
  EXPECT_EQ(picture.spec.get_string_attribute("brume:seed"), "0");
  EXPECT_EQ(picture.spec.get_string_attribute("brume:settings"), "none");
  EXPECT_EQ(picture.spec.get_string_attribute("brume:biased_settings"), "none");
  EXPECT_FALSE(exists("elsewhere/scene.exr"));
}

TEST_F(RenderCommand, WritesEveryOutputAskedFor) {
  const Ended ended = run({"render", "scene.xml", "-o", "a.exr", "-o", "b.png", "--output", "c.jpg",
                           "-o", "d.hdr", "-o", "e.PNG"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* name : {"a.exr", "b.png", "c.jpg", "d.hdr", "e.PNG"}) {
    const PictureFile picture = read(name);
    EXPECT_EQ(picture.width, 16) << name;
    EXPECT_EQ(picture.height, 12) << name;
  }
  EXPECT_FALSE(exists("scene.exr"));
}

TEST_F(RenderCommand, AcceptsTheSceneAsAnOption) {
  EXPECT_EQ(run({"render", "-s", "scene.xml", "-o", "a.exr", "--quiet"}).exit_code, 0);
  EXPECT_EQ(run({"render", "--scene=scene.xml", "-o", "b.exr", "--quiet"}).exit_code, 0);
  EXPECT_TRUE(same_bits(read("a.exr"), read("b.exr")));
}

TEST_F(RenderCommand, OptionsReplaceWhatTheSceneSays) {
  EXPECT_EQ(
      run({"render", "scene.xml", "--size", "10x6", "--spp", "2", "--seed", "7", "--max-depth", "1",
           "-D", "glow=3", "--aov", "albedo,depth", "--json", "s.json", "--quiet"})
          .exit_code,
      0);
  const PictureFile picture = read("scene.exr");
  EXPECT_EQ(picture.width, 10);
  EXPECT_EQ(picture.height, 6);
  EXPECT_THAT(picture.channels,
              ::testing::IsSupersetOf({"albedo.R", "albedo.G", "albedo.B", "depth.Z"}));
  EXPECT_EQ(picture.spec.get_int_attribute("brume:max_depth"), 1);
  EXPECT_EQ(picture.spec.get_string_attribute("brume:define:glow"), "3");
  EXPECT_FLOAT_EQ(picture.pixels[0], 3.0f);  // the sky beside the ball
  EXPECT_EQ(json("s.json")["mean_spp"], 2.0);
  EXPECT_EQ(json("s.json")["seed"], 7);
}

TEST_F(RenderCommand, ExposureBrightensTheTonedPictureOnly) {
  EXPECT_EQ(run({"render", "scene.xml", "-D", "glow=0.1", "-o", "a.exr", "-o", "a.png"}).exit_code,
            0);
  EXPECT_EQ(run({"render", "scene.xml", "-D", "glow=0.1", "-o", "b.exr", "-o", "b.png",
                 "--exposure", "2"})
                .exit_code,
            0);
  EXPECT_TRUE(same_bits(read("a.exr"), read("b.exr")));
  EXPECT_GT(read("b.png").pixels[0], 1.5f * read("a.png").pixels[0]);
}

TEST_F(RenderCommand, StatisticsAreCompleteJson) {
  EXPECT_EQ(run({"render", "scene.xml", "--spp", "80", "--json", "s.json"}).exit_code, 0);
  const nlohmann::json s = json("s.json");
  EXPECT_TRUE(s["version"].is_string());
  EXPECT_EQ(s["input"], "scene.xml");
  EXPECT_EQ(s["outputs"], nlohmann::json::array({"scene.exr"}));
  EXPECT_EQ(s["width"], 16);
  EXPECT_EQ(s["height"], 12);
  EXPECT_EQ(s["seed"], 0);
  EXPECT_EQ(s["stopped"], "sample count reached");
  EXPECT_EQ(s["min_spp"], 80);
  EXPECT_EQ(s["mean_spp"], 80.0);
  EXPECT_EQ(s["bad_samples"], 0);
  EXPECT_EQ(s["biased_settings"], nlohmann::json::array());
  EXPECT_GT(s["load_seconds"], 0.0);
  EXPECT_GT(s["render_seconds"], 0.0);
  EXPECT_GT(s["relative_rms_error"], 0.0);
  EXPECT_LT(s["relative_rms_error"], 1.0);
  EXPECT_GT(s["relative_rms_error_bound_95"], s["relative_rms_error"]);
}

TEST_F(RenderCommand, SettingsAreRecordedWhereTheyDifferFromTheDefaults) {
  const Ended ended = run({"render", "scene.xml", "--spp", "16", "--set", "sampler=independent",
                           "--set", "bounds=cells", "--json", "s.json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(read("scene.exr").spec.get_string_attribute("brume:settings"), "sampler=independent");
  EXPECT_EQ(json("s.json")["settings"], nlohmann::json({{"sampler", "independent"}}));
  EXPECT_EQ(json("s.json")["biased_settings"], nlohmann::json::array());
  EXPECT_EQ(run({"render", "scene.xml", "--spp", "16", "-o", "sobol.exr"}).exit_code, 0);
  EXPECT_FALSE(same_bits(read("scene.exr"), read("sobol.exr")));
}

TEST_F(RenderCommand, AnUnknownErrorIsNullInJson) {
  EXPECT_EQ(run({"render", "scene.xml", "--spp", "1", "--json", "s.json"}).exit_code, 0);
  EXPECT_TRUE(json("s.json")["relative_rms_error"].is_null());
}

TEST_F(RenderCommand, QuietWritesThePictureAndNothingElse) {
  for (const bool on_terminal : {false, true}) {
    if (on_terminal && !has_terminals()) GTEST_SKIP() << "no terminal to be had here";
    const std::vector<std::string> words{"render", "scene.xml", "--quiet"};
    const Ended ended = on_terminal ? run_on_terminal(words) : run(words);
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err, "");
    EXPECT_TRUE(exists("scene.exr"));
  }
}

TEST_F(RenderCommand, QuietWarns) {
  write("cloud.vol", vol_bytes({2, 2, 2}, 1, [](int x, int, int, int) { return x - 0.5; }));
  const Ended ended = run({"render", "cloud.vol", "--size", "4x3", "--spp", "1", "--quiet"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "warning: cloud.vol: 4 negative voxels were set to 0\n");
}

TEST_F(RenderCommand, SaysWhyAPictureMayBeBlack) {
  const Ended dark = run({"render", "scene.xml", "-D", "glow=0", "--max-depth", "2", "--quiet"});
  EXPECT_EQ(dark.exit_code, 0);
  EXPECT_THAT(dark.err, ::testing::StartsWith("warning: the picture is black: none of 4 samples"));
  EXPECT_THAT(dark.err, HasSubstr("max_depth, 2,"));
}

TEST_F(RenderCommand, ProgressIsPlainLinesInAFileAndABarOnATerminal) {
  const Ended in_file = run({"render", "scene.xml"});
  EXPECT_THAT(in_file.err, MatchesRegex(".*100%  4/4 spp  0:00 left .*samples/s\n"));
  EXPECT_THAT(in_file.err, Not(HasSubstr("\r")));
  EXPECT_THAT(in_file.err, Not(HasSubstr("\x1b")));

  if (!has_terminals()) GTEST_SKIP() << "no terminal to be had here";
  const Ended on_terminal = run_on_terminal({"render", "scene.xml"});
  EXPECT_THAT(on_terminal.err, HasSubstr("\r100%  [=============================]  4/4 spp"));
  EXPECT_THAT(on_terminal.err, ::testing::EndsWith("\x1b[K\r\n"));
  EXPECT_EQ(on_terminal.exit_code, 0);
}

TEST_F(RenderCommand, StopsWhenTheTimeIsSpent) {
  write_long_scene();
  const Ended ended = run({"render", "long.xml", "--time", "2s", "--json", "s.json"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_GT(ended.seconds, 1.5);
  EXPECT_LT(ended.seconds, 10.0);
  EXPECT_THAT(ended.out, HasSubstr("time spent"));
  EXPECT_EQ(json("s.json")["stopped"], "time spent");
  EXPECT_GT(json("s.json")["min_spp"], 0);
  EXPECT_TRUE(exists("long.exr"));
}

TEST_F(RenderCommand, StopsWhenTheErrorIsReached) {
  write_long_scene();
  for (const char* error : {"2%", "0.02"}) {
    const Ended ended = run({"render", "long.xml", "--error", error, "--json", "s.json"});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.out, HasSubstr("error target reached; relative RMS error"));
    EXPECT_THAT(ended.err, HasSubstr("% to 2%"));
    const nlohmann::json s = json("s.json");
    EXPECT_EQ(s["stopped"], "error target reached");
    EXPECT_LT(s["relative_rms_error_bound_95"], 0.02);
    EXPECT_GT(s["relative_rms_error_bound_95"], 0.015);
    EXPECT_LT(s["min_spp"], s["mean_spp"]);
    EXPECT_EQ(read("long.exr").spec.get_string_attribute("brume:stopped"), "error target reached");
  }
  EXPECT_EQ(
      run({"render", "long.xml", "--error", "2%", "--no-adaptive", "--json", "s.json"}).exit_code,
      0);
  EXPECT_EQ(json("s.json")["min_spp"], json("s.json")["mean_spp"]);
}

TEST_F(RenderCommand, TheStopRuleThatIsReachedFirstCounts) {
  EXPECT_THAT(run({"render", "scene.xml", "--spp", "3", "--error", "0.1%"}).out,
              HasSubstr("3 samples a pixel"));
  EXPECT_THAT(run({"render", "scene.xml", "--time", "1s", "--error", "0.001%"}).out,
              HasSubstr("time spent"));
  const Ended ended = run({"render", "scene.xml", "--spp", "3", "--time", "1h"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, HasSubstr("3 samples a pixel"));
  EXPECT_LT(ended.seconds, 60.0);
}

TEST_F(RenderCommand, CtrlCSavesWhatWasRendered) {
  write_long_scene();
  for (const int signal : {SIGINT, SIGTERM}) {
    const Ended ended = run_brume(
        {.arguments = {"render", "long.xml", "-o", "cut.exr", "-o", "cut.png", "--json", "s.json"},
         .folder = path(""),
         .when_listening = [signal](pid_t pid) {
           ::usleep(300'000);
           ::kill(pid, signal);
         }});
    EXPECT_EQ(ended.exit_code, 130);
    EXPECT_THAT(ended.out, HasSubstr("interrupted"));
    EXPECT_EQ(json("s.json")["stopped"], "interrupted");
    const PictureFile picture = read("cut.exr");
    EXPECT_EQ(picture.width, 16);
    EXPECT_GT(picture.pixels[0], 0.0f);
    EXPECT_EQ(picture.spec.get_string_attribute("brume:stopped"), "interrupted");
    EXPECT_TRUE(exists("cut.png"));
    std::filesystem::remove(path("cut.exr"));
  }
}

TEST_F(RenderCommand, APictureThatCannotBeWrittenIsKeptElsewhere) {
  write_long_scene();
  std::filesystem::create_directory(path("out"));
  std::filesystem::create_directory(path("temporary"));
  ::setenv("TMPDIR", path("temporary").c_str(), 1);
  const Ended ended = run_brume({.arguments = {"render", "long.xml", "-o", "out/cut.exr"},
                                 .folder = path(""),
                                 .when_listening = [this](pid_t pid) {
                                   std::filesystem::remove_all(path("out"));
                                   ::usleep(300'000);
                                   ::kill(pid, SIGINT);
                                 }});
  ::unsetenv("TMPDIR");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("out/cut.exr: cannot be written"));
  const std::filesystem::directory_iterator kept(path("temporary"));
  ASSERT_NE(kept, std::filesystem::directory_iterator{});
  EXPECT_THAT(ended.err, HasSubstr("what was rendered is in " + kept->path().string()));
  EXPECT_GT(read("temporary/" + kept->path().filename().string()).pixels[0], 0.0f);
}

TEST_F(RenderCommand, AnOlderPictureStaysUntilTheNewOneIsWhole) {
  write("scene.exr", "an older picture");
  write_long_scene();
  // Killed in the middle: the older file is untouched, and nothing else is left behind.
  const Ended ended = run_brume({.arguments = {"render", "long.xml", "-o", "scene.exr"},
                                 .folder = path(""),
                                 .when_listening = [](pid_t pid) { ::kill(pid, SIGKILL); }});
  EXPECT_EQ(ended.exit_code, 128 + SIGKILL);
  EXPECT_EQ(bytes("scene.exr"), "an older picture");
  EXPECT_EQ(run({"render", "scene.xml", "--quiet"}).exit_code, 0);
  EXPECT_EQ(read("scene.exr").width, 16);
}

TEST_F(RenderCommand, TheBitsDoNotDependOnTheNumberOfThreads) {
  const std::vector<std::string> common{"render", "scene.xml", "--spp", "40",
                                        "--size", "33x21",     "--aov", "albedo,depth"};
  for (const char* threads : {"1", "2", "7"}) {
    std::vector<std::string> words = common;
    words.insert(words.end(), {"--threads", threads, "-o", std::string(threads) + ".exr"});
    EXPECT_EQ(run(words).exit_code, 0);
  }
  const PictureFile one = read("1.exr");
  EXPECT_TRUE(same_bits(one, read("2.exr")));
  EXPECT_TRUE(same_bits(one, read("7.exr")));

  std::vector<std::string> words = common;
  words.insert(words.end(), {"--seed", "1", "-o", "other.exr"});
  EXPECT_EQ(run(words).exit_code, 0);
  EXPECT_FALSE(same_bits(one, read("other.exr")));
}

TEST_F(RenderCommand, RendersABareVolumeAndPrintsWhatItChose) {
  write("cloud.vol", vol_bytes({8, 8, 8}, 1, [](int x, int y, int z, int) {
          return double((x - 4) * (x - 4) + (y - 4) * (y - 4) + (z - 4) * (z - 4) < 12);
        }));
  const Ended ended = run({"render", "cloud.vol", "--size", "24x16", "--spp", "4"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* chosen : {"note: ", "camera", "sun", "density"})
    EXPECT_THAT(ended.err, HasSubstr(chosen));
  EXPECT_EQ(read("cloud.exr").width, 24);

  const Ended overridden =
      run({"render", "cloud.vol", "--size", "24x16", "--spp", "4", "--density-scale", "40", "--g",
           "0", "--albedo", "0.5,0.8,1", "--grid", "", "-o", "other.exr"});
  EXPECT_EQ(overridden.exit_code, 0) << overridden.err;
  EXPECT_FALSE(same_bits(read("cloud.exr"), read("other.exr")));
}

TEST_F(RenderCommand, FindsTheDensityOfAVdbAndListsGridsWhenAskedForAnother) {
  write_constant_vdb(path("cloud.vdb"), 9, 0.5);
  const Ended ended = run({"render", "cloud.vdb", "--size", "12x8", "--spp", "2", "-o", "a.exr"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(run({"render", "cloud.vdb", "--grid", "density", "--size", "12x8", "--spp", "2", "-o",
                 "b.exr"})
                .exit_code,
            0);
  EXPECT_TRUE(same_bits(read("a.exr"), read("b.exr")));

  const Ended misspelt = run({"render", "cloud.vdb", "--grid", "densty", "-o", "c.exr"});
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("\"densty\""));
  EXPECT_THAT(misspelt.err, HasSubstr("did you mean \"density\"?"));
  EXPECT_FALSE(exists("c.exr"));

  const Ended info = run({"info", "cloud.vdb"});
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.out, HasSubstr("cloud.vdb: 1 grid"));
  EXPECT_THAT(info.out, HasSubstr("density: float, fog volume, 729 active voxels"));
}

TEST_F(RenderCommand, ATruncatedVolumeIsRefused) {
  write_constant_vdb(path("whole.vdb"), 9, 0.5);
  const std::string whole = bytes("whole.vdb");
  write("cut.vdb", whole.substr(0, whole.size() / 2));
  const Ended ended = run({"render", "cut.vdb"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, ::testing::StartsWith("brume: cut.vdb: "));
  EXPECT_FALSE(exists("cut.exr"));
}

}  // namespace
}  // namespace brume::test
