// SPDX-License-Identifier: Apache-2.0
#include "core/sampler.h"

#include <gtest/gtest.h>

#include <set>

#include "support/statistics.h"

namespace brume {
namespace {

TEST(Sampler, SkippedNumbersAreThoseThatOthersDraw) {
  Sampler draws(1, 2, 3), skips(1, 2, 3);
  const Vec2 left_out = draws.next_2d();
  skips.skip_2d();
  const Vec2 next = skips.next_2d();
  EXPECT_EQ(draws.next_2d(), next);
  EXPECT_NE(next, left_out);
}

TEST(SamplerSplit, PartsAreStratifiedOverSamples) {
  for (std::uint32_t part = 0; part < 2; ++part) {
    std::set<int> strata;
    for (std::uint32_t i = 0; i < Sampler::kReplication; ++i) {
      Sampler own = Sampler(5, 3, i).split(part);
      strata.insert(int(own.next_1d() * float(Sampler::kReplication)));
    }
    EXPECT_EQ(strata.size(), Sampler::kReplication) << "part " << part;
  }
}

TEST(SamplerSplit, PartsAreIndependentOfTheWholeAndOfEachOther) {
  test::RunningMean with_whole, with_other, of_streams, with_whole_stream, first;
  for (std::uint32_t i = 0; i < 64 * 400; i += 7) {  // of different replications
    Sampler whole(5, 3, i);
    Sampler a = whole.split(0), b = whole.split(1);
    const float of_a = a.next_1d() - 0.5f, of_stream = a.rng().next_float() - 0.5f;
    first.add(of_a);
    with_whole.add(of_a * (whole.next_1d() - 0.5f));
    with_other.add(of_a * (b.next_1d() - 0.5f));
    of_streams.add(of_stream * (b.rng().next_float() - 0.5f));
    with_whole_stream.add(of_stream * (whole.rng().next_float() - 0.5f));
  }
  for (const test::RunningMean& mean :
       {first, with_whole, with_other, of_streams, with_whole_stream})
    EXPECT_TRUE(test::agrees(mean, 0.0));
}

TEST(SamplerSplit, KeepsTheBlockOfTheSample) {
  const Sampler whole(5, 3, 37);
  EXPECT_EQ(whole.split(1).block_seed(), whole.block_seed());
  EXPECT_EQ(whole.split(1).index_in_block(), whole.index_in_block());
}

}  // namespace
}  // namespace brume
