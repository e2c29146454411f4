// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdlib>
#include <set>

#include "cli/cli_fixture.h"

namespace brume::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Trade : public CliTest {};

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// The command of a browser that renders without a screen; empty where there is none.
std::string browser() {
  for (const std::string name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0) return name;
  return {};
}

TEST_F(Trade, MeasuresWithinItsBudgetAndWritesThreeReports) {
  const Ended ended = run({"trade", "scene.xml", "--budget", "15s", "-o", "report.html"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_LT(ended.seconds, 1.1 * 15.0);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("measuring default"), HasSubstr("left")));
  EXPECT_THAT(ended.out, AllOf(HasSubstr("default"), HasSubstr("for 1.0% use ")));

  const nlohmann::json report = json("report.json");
  EXPECT_TRUE(report["complete"].get<bool>());
  EXPECT_EQ(report["width"], 16);
  std::set<std::string> names;
  for (const auto& setting : report["settings"]) names.insert(setting["setting"]);
  // What has no grids has no use for lookups and marching.
  EXPECT_TRUE(names.contains("default"));
  EXPECT_TRUE(names.contains("max depth 2"));
  EXPECT_TRUE(names.contains("similarity=4"));
  EXPECT_FALSE(names.contains("lookup=nearest"));
  EXPECT_EQ(report["recommendations"].size(), 7u);
  for (const auto& setting : report["settings"])
    EXPECT_EQ(setting["biased"].get<bool>(),
              setting["setting"].get<std::string>().starts_with("max depth") ||
                  setting["setting"].get<std::string>().starts_with("similarity") ||
                  setting["setting"].get<std::string>().starts_with("clamp"));
  EXPECT_EQ(count(bytes("report.csv"), "\n"), 1 + names.size());
}

TEST_F(Trade, ReportRendersInABrowser) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no chromium here to show the report with";
  ASSERT_EQ(run({"trade", "scene.xml", "--budget", "8s", "-o", "report.html"}).exit_code, 0);
  const std::string folder = path("").string();
  const std::string command =
      "cd '" + folder + "' && HOME='" + folder + "' timeout 60 " + program +
      " --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1000,3000" +
      " --enable-logging=stderr";
  const std::string page = " 'file://" + path("report.html").string() + "'";
  ASSERT_EQ(std::system((command + " --dump-dom" + page + " >dom.html 2>log.txt").c_str()), 0);
  EXPECT_THAT(bytes("log.txt"), Not(HasSubstr("CONSOLE")));
  const std::string dom = bytes("dom.html");
  const std::string table =
      dom.substr(dom.find("id=\"settings\""),
                 dom.find("</table>", dom.find("id=\"settings\"")) - dom.find("id=\"settings\""));
  EXPECT_EQ(count(table, "<tr"), 1 + json("report.json")["settings"].size());
  EXPECT_EQ(count(dom, "<svg"), 3u);

  // Ink of every colour reaches the screen, to the last picture.
  ASSERT_EQ(std::system((command + " --screenshot=page.png" + page + " >/dev/null 2>&1").c_str()),
            0);
  const PictureFile page_seen = read("page.png");
  std::set<std::array<float, 3>> colours;
  for (std::size_t i = 0; i < page_seen.pixels.size(); i += page_seen.channels.size())
    colours.insert({page_seen.pixels[i], page_seen.pixels[i + 1], page_seen.pixels[i + 2]});
  EXPECT_GT(colours.size(), 500u);
}

TEST_F(Trade, AReferenceOfTheUsersIsTaken) {
  ASSERT_EQ(run({"render", "scene.xml", "--spp", "2048", "--quiet"}).exit_code, 0);
  const Ended ended = run({"trade", "scene.xml", "--budget", "5s", "--reference", "scene.exr",
                           "--quiet", "-o", "report.html"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(json("report.json")["reference_spp"].is_null());
  EXPECT_EQ(json("report.json")["height"], 12);
}

TEST_F(Trade, CtrlCEndsItSoon) {
  const Ended ended =
      run_brume({.arguments = {"trade", "scene.xml", "--budget", "100s", "-o", "report.html"},
                 .folder = path(""),
                 .when_listening = [](pid_t process) { ::kill(process, SIGINT); }});
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_LT(ended.seconds, 50.0);
}

TEST_F(Trade, MistakesAreRefusedBeforeAnythingIsRendered) {
  expect_refusal({"trade", "scene.xml", "-o", "report.txt"}, 2,
                 "brume: report.txt: a report is an .html file\n");
  expect_refusal({"trade", "scene.xml", "--reference", "none.exr"}, 2,
                 "brume: none.exr: no such file\n");
  EXPECT_EQ(run({"trade", "none.xml"}).exit_code, run({"render", "none.xml"}).exit_code);
  EXPECT_EQ(run({"trade", "scene.xml", "--budget", "soon"}).exit_code, 2);
  EXPECT_EQ(run({"trade", "scene.xml", "-o", "nowhere/report.html"}).exit_code, 1);
  const Ended dark = run({"trade", "scene.xml", "-D", "glow=0"});
  EXPECT_EQ(dark.exit_code, 2);
  EXPECT_THAT(dark.err, HasSubstr("its picture is black"));
}

}  // namespace
}  // namespace brume::test
