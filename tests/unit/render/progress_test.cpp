// SPDX-License-Identifier: Apache-2.0
#include "render/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <thread>

namespace brume {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr ProgressState kHalfway{.pixels = 10000,
                                 .samples = 320000,
                                 .target_spp = 64.0,
                                 .seconds = 75.0,
                                 .seconds_limit = INFINITY};

TEST(ProgressLine, SaysHowFarAndHowLong) {
  EXPECT_EQ(plain_line(kHalfway), " 50%  32.0/64 spp  1:15 left  1:15 elapsed  4.27k samples/s");
}

TEST(ProgressLine, BarFillsWithTheFraction) {
  EXPECT_THAT(bar_line(kHalfway, 200),
              StartsWith(" 50%  [====================>                   ]  32.0/64 spp"));
  ProgressState done = kHalfway;
  done.samples = 640000;
  EXPECT_THAT(bar_line(done, 200),
              StartsWith("100%  [========================================]  64/64 spp  0:00 left"));
}

TEST(ProgressLine, FitsTheTerminal) {
  std::size_t shortest = 1000;
  for (int columns = 200; columns >= 0; --columns) {
    const std::string line = bar_line(kHalfway, columns);
    EXPECT_LE(line.size(), std::size_t(columns));
    EXPECT_LE(line.size(), shortest + 45) << columns;
    shortest = std::min(shortest, line.size());
  }
  EXPECT_THAT(bar_line(kHalfway, 60), Not(HasSubstr("[")));
  EXPECT_EQ(bar_line(kHalfway, 20), " 50%  32.0/64 spp");
  EXPECT_EQ(bar_line(kHalfway, 5), " 50%");
}

TEST(ProgressLine, TimeLimitCountsWhenItComesFirst) {
  ProgressState state = kHalfway;
  state.seconds_limit = 100.0;
  EXPECT_THAT(plain_line(state), StartsWith(" 75%  32.0/64 spp  0:25 left"));
  state.target_spp = INFINITY;
  EXPECT_THAT(plain_line(state), StartsWith(" 75%  32.0 spp  0:25 left"));
  state.seconds_limit = INFINITY;
  EXPECT_THAT(plain_line(state), StartsWith("  0%  32.0 spp  1:15 elapsed"));
}

TEST(ProgressLine, ForecastsWhenTheErrorIsReached) {
  // Half the error takes four times the samples, of which a half more than then are done.
  ProgressState state = kHalfway;
  state.target_spp = INFINITY;
  state.error = 0.02;
  state.samples_at_error = 213333;
  state.target_error = 0.01;
  EXPECT_EQ(plain_line(state),
            " 37%  32.0 spp  2:05 left  error <2% to 1%  1:15 elapsed  4.27k samples/s");
  state.target_spp = 64.0;  // is reached before
  EXPECT_THAT(plain_line(state), StartsWith(" 50%  32.0/64 spp  1:15 left  error <2% to 1%"));
  state.target_error = 0.0;
  EXPECT_THAT(plain_line(state), StartsWith(" 50%  32.0/64 spp  1:15 left  error <2%  "));
}

TEST(ProgressLine, WhatAnEarlierRunDidTookNoneOfThisTime) {
  ProgressState state = kHalfway;
  state.samples_before = 160000;
  state.samples = 160000;
  EXPECT_EQ(plain_line(state), " 50%  32.0/64 spp  2:30 left  1:15 elapsed  2.13k samples/s");
}

TEST(ProgressLine, StartIsNotMistakenForTheEnd) {
  ProgressState state = kHalfway;
  state.samples = 0;
  state.seconds = 0.0;
  EXPECT_EQ(plain_line(state), "  0%  0.0/64 spp  0:00 elapsed");
  state.samples = 639999;
  state.seconds = 40000.0;
  EXPECT_THAT(plain_line(state), StartsWith(" 99%  63.9/64 spp  0:00 left  11:06:40 elapsed"));
}

/// What a short render writes in `style`.
std::string output_of(ProgressStyle style) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = ::open_memstream(&text, &size);
  {
    ProgressState start = kHalfway;
    start.samples = 0;
    Progress progress(style, start, stream);
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    progress.add(640000);
  }
  std::fclose(stream);
  const std::string result(text, size);
  std::free(text);
  return result;
}

TEST(Progress, BarIsRedrawnInPlaceAndFinished) {
  const std::string output = output_of(ProgressStyle::kBar);
  EXPECT_THAT(output, StartsWith("\r  0%"));
  EXPECT_GE(std::count(output.begin(), output.end(), '\r'), 3);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1);
  EXPECT_THAT(output, HasSubstr("\r100%"));
  EXPECT_THAT(output, EndsWith("\x1b[K\n"));
}

TEST(Progress, ShortRenderHasOnePlainLine) {
  const std::string output = output_of(ProgressStyle::kPlain);
  EXPECT_THAT(output, StartsWith("100%"));
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1);
  EXPECT_THAT(output, Not(HasSubstr("\x1b")));
}

TEST(Progress, QuietMeansQuiet) {
  EXPECT_EQ(output_of(ProgressStyle::kQuiet), "");
}

}  // namespace
}  // namespace brume
