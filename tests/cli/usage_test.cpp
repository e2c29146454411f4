// SPDX-License-Identifier: Apache-2.0
#include "cli/cli_fixture.h"

namespace brume::test {
namespace {

using ::testing::HasSubstr;

class Usage : public CliTest {};

TEST_F(Usage, HelpTellsEveryOptionAndGoesToStdout) {
  const Ended ended = run({"render", "--help"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "");
  for (const char* option : {"INPUT",       "-s,--scene", "-o,--output",   "--spp",
                             "--time",      "--error",    "--no-adaptive", "--checkpoint-every",
                             "--resume",    "--size",     "--exposure",    "--aov",
                             "--max-depth", "-D",         "--grid",        "--density-scale",
                             "--albedo",    "--g ",       "--seed",        "--threads",
                             "--quiet",     "--json",     "--set",         "near-lights",
                             "textbook",    ".xml",       ".vdb",          ".nvdb",
                             ".vol",        ".exr",       ".png",          ".jpg",
                             ".hdr",        "-h,--help"})
    EXPECT_THAT(ended.out, HasSubstr(option));

  const Ended info = run({"info", "--help"});
  EXPECT_EQ(info.exit_code, 0);
  for (const char* option : {"INPUT", "-s,--scene", "-D", "-h,--help"})
    EXPECT_THAT(info.out, HasSubstr(option));
}

TEST_F(Usage, HelpOfTheProgramTellsCommandsAndExitCodes) {
  const Ended ended = run({"--help"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "");
  for (const char* word : {"render", "info", "compare", "trade", "--version", "130"})
    EXPECT_THAT(ended.out, HasSubstr(word));
}

TEST_F(Usage, VersionGoesToStdout) {
  const Ended ended = run({"--version"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, ::testing::MatchesRegex("brume [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(Usage, NothingSaidIsAMistake) {
  expect_refusal({}, 2,
                 "brume: a command is needed: render, info, compare, trade\nTry: brume --help\n");
  expect_refusal({"render"}, 2, "brume: INPUT is required\nTry: brume render --help\n");
}

TEST_F(Usage, UnknownNamesAreAnsweredWithTheNearest) {
  expect_refusal({"rendr", "scene.xml"}, 2,
                 "brume: unknown command \"rendr\"; did you mean \"render\"?\nTry: brume --help\n");
  expect_refusal({"paint", "scene.xml"}, 2,
                 "brume: unknown command \"paint\"; expected one of render, info, compare, trade\n"
                 "Try: brume --help\n");
  expect_refusal({"--versoin"}, 2,
                 "brume: unknown option \"--versoin\"; did you mean \"--version\"?\n"
                 "Try: brume --help\n");
  expect_refusal({"render", "scene.xml", "--sp", "3"}, 2,
                 "brume: unknown option \"--sp\"; did you mean \"--spp\"?\n"
                 "Try: brume render --help\n");
  expect_refusal(
      {"render", "scene.xml", "--set", "lokup=trilinear"}, 2,
      "brume: --set lokup=trilinear: no setting has this name; did you mean \"lookup\"?\n");
  expect_refusal({"info", "scene.xml", "--scenes", "3"}, 2,
                 "brume: unknown option \"--scenes\"; did you mean \"--scene\"?\n"
                 "Try: brume info --help\n");
  expect_refusal({"render", "scene.xml", "-D", "glo=2"}, 2,
                 "brume: -D glo=2: scene.xml has no parameter of that name; did you mean "
                 "\"glow\"?\n");
  expect_refusal({"render", "scene.xml", "other.xml"}, 2,
                 "brume: one argument too many: \"other.xml\"\nTry: brume render --help\n");
}

TEST_F(Usage, ValuesThatMakeNoSenseAreRefused) {
  const std::string try_help = "\nTry: brume render --help\n";
  expect_refusal({"render", "scene.xml", "--spp", "0"}, 2,
                 "brume: --spp: Value 0 not in range 1 to 1073741824" + try_help);
  expect_refusal({"render", "scene.xml", "--time", "-3"}, 2,
                 "brume: --time: \"-3\" is no duration; write 90s, 5m or 1.5h" + try_help);
  expect_refusal({"render", "scene.xml", "--time", "5 parsecs"}, 2,
                 "brume: --time: \"5 parsecs\" is no duration; write 90s, 5m or 1.5h" + try_help);
  for (const std::string error : {"5", "0", "-1%", "100%", "1 %", "little", "nan"})
    expect_refusal({"render", "scene.xml", "--error", error}, 2,
                   "brume: --error: \"" + error +
                       "\" is no relative error below 1; write 1% or 0.01" + try_help);
  expect_refusal({"render", "scene.xml", "--size", "640"}, 2,
                 "brume: --size: \"640\" is no picture size; write width x height in pixels, such "
                 "as 1280x720, each at most 65536" +
                     try_help);
  expect_refusal({"render", "scene.xml", "-D", "glow"}, 2,
                 "brume: -D: \"glow\" defines nothing; write name=value" + try_help);
  expect_refusal({"render", "scene.xml", "--albedo", "1.5"}, 2,
                 "brume: --albedo: \"1.5\" is no albedo; write one number in [0, 1] or three, such "
                 "as 0.9,0.95,1" +
                     try_help);
  for (const char* cut : {"0.5,", "0.5,0.5", "0.5,,0.5", ""})
    EXPECT_EQ(run({"render", "scene.xml", "--albedo", cut}).exit_code, 2) << cut;
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--threads", "0"},
                                                {"--g", "1.5"},
                                                {"--g", "nan"},
                                                {"--exposure", "nan"},
                                                {"--density-scale", "nan"},
                                                {"--density-scale", "1e39"},
                                                {"--density-scale", "-1"},
                                                {"--max-depth", "-2"},
                                                {"--aov", "normals"},
                                                {"--seed", "one"}}) {
    const Ended ended = run({"render", "scene.xml", words[0], words[1]});
    EXPECT_EQ(ended.exit_code, 2) << words[0];
    EXPECT_THAT(ended.err, HasSubstr(words[0]));
    EXPECT_THAT(ended.err, HasSubstr(words[1]));
  }
}

TEST_F(Usage, OptionsForVolumesAreRefusedForScenesAndTheOtherWayRound) {
  expect_refusal({"render", "scene.xml", "--g", "0.5"}, 2,
                 "brume: --grid, --density-scale, --albedo and --g are for a bare volume; "
                 "scene.xml is a scene and says so itself\n");
  expect_refusal({"render", "cloud.vdb", "-D", "glow=2"}, 2,
                 "brume: -D glow sets a parameter of a scene, and cloud.vdb is a bare volume\n");
}

TEST_F(Usage, FilesThatAreNoInputAreNamed) {
  expect_refusal({"render", ""}, 2, "brume: INPUT: the name is empty\nTry: brume render --help\n");
  expect_refusal({"render", "nowhere.xml"}, 2, "brume: nowhere.xml: No such file or directory\n");
  expect_refusal({"render", "nowhere.vdb"}, 2, "brume: nowhere.vdb: No such file or directory\n");
  expect_refusal({"info", "nowhere.xml"}, 2, "brume: nowhere.xml: No such file or directory\n");
  expect_refusal({"render", "scene.blend"}, 2,
                 "brume: scene.blend: the extension says neither scene (.xml) nor volume (.vdb, "
                 ".nvdb, .vol)\n");
  write("not_really.vdb", "this is no volume");
  const Ended ended = run({"render", "not_really.vdb"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("not_really.vdb"));
}

TEST_F(Usage, OutputsThatCannotBeWrittenAreRefusedBeforeAnyWork) {
  expect_refusal({"render", "scene.xml", "-o", "picture.tiff"}, 2,
                 "brume: picture.tiff: unknown format \".tiff\"; pictures are written as .exr, "
                 ".png, .jpg, .jpeg or .hdr\n");
  expect_refusal({"render", "scene.xml", "-o", "nowhere/picture.exr"}, 1,
                 "brume: nowhere/picture.exr: cannot be written: there is no folder nowhere\n");
  expect_refusal({"render", "scene.xml", "-o", "a.exr", "-o", "nowhere/b.png"}, 1,
                 "brume: nowhere/b.png: cannot be written: there is no folder nowhere\n");
  expect_refusal({"render", "scene.xml", "-o", "scene.xml/picture.exr"}, 1,
                 "brume: scene.xml/picture.exr: cannot be written: scene.xml is not a folder\n");
  expect_refusal({"render", "scene.xml", "--json", "nowhere/statistics.json"}, 1,
                 "brume: nowhere/statistics.json: cannot be written: there is no folder nowhere\n");
  EXPECT_FALSE(exists("a.exr"));
  std::filesystem::create_directory(path("taken.exr"));
  expect_refusal({"render", "scene.xml", "-o", "taken.exr"}, 1,
                 "brume: taken.exr: cannot be written: it is a folder\n");
}

TEST_F(Usage, BrokenScenesAreAnsweredWithWhereAndWhat) {
  const auto message_of = [&](const std::string& xml) {
    write("broken.xml", xml);
    const Ended ended = run({"render", "broken.xml"});
    EXPECT_EQ(ended.exit_code, 2) << xml;
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(exists("broken.exr"));
    return ended.err;
  };
  EXPECT_EQ(message_of("<scene version=\"3.0.0\">\n  <sensor type=\"perspective\">\n    <flot "
                       "name=\"fov\" value=\"40\"/>\n  </sensor>\n</scene>\n"),
            "brume: broken.xml:3:6: unknown element <flot>; did you mean \"float\"?\n"
            "      <flot name=\"fov\" value=\"40\"/>\n       ^\n");
  EXPECT_EQ(message_of("<scene version=\"3.0.0\">\n  <sensor type=\"perspective\">\n    <float "
                       "name=\"fob\" value=\"40\"/>\n  </sensor>\n</scene>\n"),
            "brume: broken.xml:3:6: unknown parameter \"fob\" of perspective sensor; did you mean "
            "\"fov\"?\n      <float name=\"fob\" value=\"40\"/>\n       ^\n");
  EXPECT_EQ(message_of("<scene version=\"3.0.0\">\n  <shape type=\"spere\"/>\n  <sensor "
                       "type=\"perspective\"/>\n</scene>\n"),
            "brume: broken.xml:2:16: the shape type \"spere\" is not supported; did you mean "
            "\"sphere\"? Supported: obj, ply, sphere, rectangle, cube, disk, cylinder\n"
            "    <shape type=\"spere\"/>\n                 ^\n");
  EXPECT_THAT(message_of("<scene version=\"3.0.0\">\n  <sensor type=\"perspective\">\n</scene>\n"),
              ::testing::StartsWith("brume: broken.xml:"));
  EXPECT_THAT(message_of(""), ::testing::StartsWith("brume: broken.xml"));
}

TEST_F(Usage, InfoTellsWhatASceneRequiresAndRendersNothing) {
  const Ended ended = run({"info", "scene.xml"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "");
  for (const char* words : {"16x12", "4 samples a pixel", "yes surfaces", "no  null-collision"})
    EXPECT_THAT(ended.out, HasSubstr(words));
  EXPECT_FALSE(exists("scene.exr"));
}

}  // namespace
}  // namespace brume::test
