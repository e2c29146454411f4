// SPDX-License-Identifier: Apache-2.0
#include <csignal>

#include "cli/cli_fixture.h"

namespace brume::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CheckpointCommand : public CliTest {
 protected:
  Ended run_and(int signal, std::vector<std::string> arguments, int microseconds) const {
    return run_brume(
        {.arguments = std::move(arguments), .folder = path(""), .when_listening = [=](pid_t pid) {
           ::usleep(microseconds);
           ::kill(pid, signal);
         }});
  }
};

TEST_F(CheckpointCommand, KilledAndResumedTheBitsAreTheSame) {
  const std::vector<std::string> common{"render", "scene.xml", "--size", "24x16", "--quiet"};
  const auto words = [&](std::vector<std::string> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return more;
  };
  EXPECT_EQ(run(words({"--error", "0.5%", "-o", "whole.exr"})).exit_code, 0);
  const std::vector<std::string> stepwise =
      words({"--error", "0.5%", "-o", "steps.exr", "--checkpoint-every", "0.05s", "--resume"});
  EXPECT_EQ(run_and(SIGKILL, stepwise, 150'000).exit_code, 128 + SIGKILL);
  EXPECT_TRUE(exists("steps.exr.checkpoint"));
  EXPECT_EQ(run_and(SIGINT, stepwise, 100'000).exit_code, 130);
  EXPECT_EQ(run(stepwise).exit_code, 0);
  EXPECT_TRUE(same_bits(read("steps.exr"), read("whole.exr")));
  for (const auto& entry : std::filesystem::directory_iterator(path("")))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("partial")));
}

TEST_F(CheckpointCommand, ResumedForMoreSamplesTheBitsAreThoseOfAllAtOnce) {
  EXPECT_EQ(run({"render", "scene.xml", "--spp", "50", "-o", "all.exr"}).exit_code, 0);
  for (const char* spp : {"7", "20", "50"})
    EXPECT_EQ(run({"render", "scene.xml", "--spp", spp, "-o", "steps.exr", "--resume"}).exit_code,
              0);
  EXPECT_TRUE(same_bits(read("steps.exr"), read("all.exr")));
  EXPECT_FALSE(exists("all.exr.checkpoint"));
}

TEST_F(CheckpointCommand, NothingToResumeIsSaidAndRendered) {
  const Ended ended = run({"render", "scene.xml", "--resume"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.err, HasSubstr("note: there is no scene.exr.checkpoint to resume: rendering "
                                   "from the start"));
}

TEST_F(CheckpointCommand, TheCheckpointOfAnotherRenderIsRefusedWithWhatDiffers) {
  EXPECT_EQ(run({"render", "scene.xml", "--resume", "-D", "glow=2"}).exit_code, 0);
  const auto refusal = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "scene.xml", "--resume"});
    const Ended ended = run(more);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.err, HasSubstr("scene.exr.checkpoint belongs to another render:"));
    return ended.err;
  };
  EXPECT_THAT(refusal({}), HasSubstr("-D glow: 2 there, none here"));
  EXPECT_THAT(
      refusal({"-D", "glow=2", "--seed", "5", "--size", "17x12"}),
      AllOf(HasSubstr("--seed: 0 there, 5 here"),
            HasSubstr("size of the picture: 16x12 there, 17x12 here"), Not(HasSubstr("glow"))));
  EXPECT_THAT(refusal({"-D", "glow=2", "--set", "near-lights=off", "--max-depth", "4"}),
              AllOf(HasSubstr("--set near-lights: none there, off here"),
                    HasSubstr("maximum depth: -1 there, 4 here")));
  std::string changed = kScene;
  changed.replace(changed.find("value=\"40\""), 10, "value=\"41\"");
  write("scene.xml", changed);
  EXPECT_THAT(refusal({"-D", "glow=2"}), HasSubstr("content of scene.xml: "));
}

TEST_F(CheckpointCommand, ADamagedCheckpointIsRefused) {
  EXPECT_EQ(run({"render", "scene.xml", "--resume"}).exit_code, 0);
  std::filesystem::resize_file(path("scene.exr.checkpoint"), 5000);
  const Ended ended = run({"render", "scene.xml", "--resume"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err,
            "brume: scene.exr.checkpoint is damaged: it ends too early; remove it to "
            "render from the start\n");
}

}  // namespace
}  // namespace brume::test
