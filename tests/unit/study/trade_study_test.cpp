// SPDX-License-Identifier: Apache-2.0
#include "study/trade_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/error.h"
#include "study/data_uri.h"
#include "study/report_text.h"
#include "study/trade_report.h"
#include "unit/study/pictures.h"

namespace brume {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Without the encoded pictures, which may spell anything.
std::string without_pictures(std::string html) {
  for (std::size_t at = html.find("base64,"); at != html.npos; at = html.find("base64,", at + 1))
    html.erase(at + 7, html.find('"', at) - at - 7);
  return html;
}

/// Noise of variance 1 a sample around 1, or around 0.9 where the trial is biased. A sample of all
/// pixels takes a tenth of a millisecond, or a twentieth of a second of a trial called "slow".
class NoiseSubject final : public Subject {
 public:
  explicit NoiseSubject(float level = 1.0f) : level_(level) {}
  void prepare(const Trial& trial) override { trial_ = trial; }
  Rendered render(std::uint32_t spp, std::uint64_t seed) override {
    const double seconds = spp * (trial_.name == "slow" ? 0.05 : 1e-4);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    Rng rng(seed);
    const float level = trial_.biased ? 0.9f * level_ : level_;
    const auto draw = [&] {
      return level + level_ * std::sqrt(12.0f / float(spp)) * (rng.next_float() - 0.5f);
    };
    return {test::picture(40, 30, [&](int, int) { return Rgb(draw(), draw(), draw()); }), seconds};
  }
  std::size_t memory_bytes() const override { return 12'000'000; }

 private:
  float level_;
  Trial trial_;
};

const std::vector<Trial> kTrials = {{.name = "default", .group = "default"},
                                    {.name = "dark<&", .group = "dark", .biased = true},
                                    {.name = "slow", .group = "slow"},
                                    {.name = "16 samples", .group = "samples", .spp = 16}};

TEST(TradeStudy, FindsBiasAndVarianceWithinItsTime) {
  NoiseSubject subject;
  int reports = 0;
  const auto begin = std::chrono::steady_clock::now();
  const Study study =
      run_study(subject, kTrials, {.seconds = 3.0, .report = [&](const StudyProgress& p) {
                                     EXPECT_GE(p.seconds_left, 0.0);
                                     ++reports;
                                   }});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LT(seconds, 1.1 * 3.0);
  EXPECT_GT(reports, 4);
  EXPECT_TRUE(study.complete);

  ASSERT_EQ(study.results.size(), 3u);
  EXPECT_THAT(study.skipped, ::testing::ElementsAre(HasSubstr("slow: ")));
  for (const TrialResult& r : study.results) {
    EXPECT_GE(r.seeds, 2);
    EXPECT_NEAR(r.accuracy.variance * r.spp, 1.0, 0.1) << r.trial.name;
    EXPECT_NEAR(r.seconds, r.spp * 1e-4, 1e-9);
    const double bias = r.trial.biased ? 0.1 : 0.0;
    EXPECT_NEAR(r.accuracy.squared_bias.value, bias * bias, 2.3 * r.accuracy.squared_bias.error);
    EXPECT_NEAR(r.accuracy.mean_bias.value, -bias, 2.3 * r.accuracy.mean_bias.error);
  }
  EXPECT_EQ(study.results[2].spp, 16u);
}

TEST(TradeStudy, EndsWhenItIsTold) {
  NoiseSubject subject;
  int asked = 0;
  const Study study = run_study(subject, kTrials,
                                {.seconds = 600.0,
                                 .reference = reference_of_picture(subject.render(16, 1).picture),
                                 .stops = [&] { return ++asked > 0; }});
  EXPECT_FALSE(study.complete);
  EXPECT_FALSE(study.reference_spp);
}

TEST(TradeStudy, ABlackPictureIsRefused) {
  NoiseSubject subject(0.0f);
  EXPECT_THROW(run_study(subject, kTrials, {.seconds = 0.5}), Error);
}

TEST(TradeReport, HoldsEveryRowAndNothingFromElsewhere) {
  NoiseSubject subject;
  const Study study = run_study(subject, kTrials, {.seconds = 1.0});
  const ReportInfo info{.input = "a \"b\".xml",
                        .command = "brume render a",
                        .version = "1.2.3",
                        .threads = 2,
                        .budget = 1.0,
                        .seconds = 1.0,
                        .size = {40, 30},
                        .full_size = {400, 300}};
  EXPECT_EQ(info.scale(), 100.0);
  const std::string html = html_report(study, info);
  for (const char* part : {"<!DOCTYPE html>", "dark&lt;&amp;", "a &quot;b&quot;.xml",
                           "slow: ", "data:image/png;base64,iVBOR", "<svg", "</html>"})
    EXPECT_THAT(html, HasSubstr(part));
  const std::string text = without_pictures(html);
  for (const char* part : {"http", "<script", "dark<", "nan", "inf"})
    EXPECT_THAT(text, Not(HasSubstr(part)));

  const std::string csv = csv_report(study, info);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_THAT(text_table(study, info), HasSubstr("dark<& *"));
  EXPECT_THAT(text_recommendations(study, info), HasSubstr("for 1.0% use default"));
}

TEST(ReportText, NumbersAsPeopleWriteThem) {
  EXPECT_EQ(duration_text(0.14), "0.14 s");
  EXPECT_EQ(duration_text(14.2), "14 s");
  EXPECT_EQ(duration_text(1260.0), "21 min");
  EXPECT_EQ(duration_text(11520.0), "3.2 h");
  EXPECT_EQ(duration_text(1e6), "12 days");
  EXPECT_EQ(percent_text(0.0), "0%");
  EXPECT_EQ(percent_text(0.0035), "0.35%");
  EXPECT_EQ(root_text({.value = 0.01, .low = 0.009, .high = 0.011}), "1.0% ± 0.1%");
  EXPECT_EQ(root_text({.value = 0.01, .low = 0.0, .high = 0.02}), "below 2.0%");
  EXPECT_EQ(signed_text({.value = -0.012, .error = 0.003}), "−1.2% ± 0.3%");
  EXPECT_EQ(memory_text(12'300'000), "12 MB");
}

TEST(DataUri, TestVectorsOfTheStandard) {
  const auto encoded = [](std::string_view text) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    return png_data_uri({bytes, text.size()}).substr(std::string("data:image/png;base64,").size());
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace brume
