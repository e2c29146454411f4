// SPDX-License-Identifier: Apache-2.0
#include "core/sampler.h"

#include <gtest/gtest.h>

#include <set>

#include "support/statistics.h"

namespace brume {
namespace {

TEST(SamplerSplit, PartsStratifyEachOther) {
  constexpr int kParts = 2, kSamples = int(Sampler::kReplication) / kParts;
  std::set<int> strata;
  for (int i = 0; i < kSamples; ++i) {
    for (std::uint32_t part = 0; part < kParts; ++part) {
      Sampler own = Sampler(5, 3, std::uint32_t(i)).split(part, kParts);
      strata.insert(int(own.next_1d() * kParts * kSamples));
    }
  }
  EXPECT_EQ(strata.size(), std::size_t(kParts * kSamples));
}

TEST(SamplerSplit, PartsAreIndependentOfTheWholeAndOfEachOthersStreams) {
  test::RunningMean with_whole, of_streams, first;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Sampler whole(5, 3, i);
    Sampler a = whole.split(0, 2), b = whole.split(1, 2);
    const float of_a = a.next_1d() - 0.5f;
    first.add(of_a);
    with_whole.add(of_a * (whole.next_1d() - 0.5f));
    of_streams.add((a.rng().next_float() - 0.5f) * (b.rng().next_float() - 0.5f));
  }
  EXPECT_NEAR(first.mean(), 0.0, 1e-3);
  EXPECT_TRUE(test::agrees(with_whole, 0.0));
  EXPECT_TRUE(test::agrees(of_streams, 0.0));
}

TEST(SamplerSplit, KeepsTheBlockOfTheSample) {
  const Sampler whole(5, 3, 37);
  EXPECT_EQ(whole.split(1, 2).block_seed(), whole.block_seed());
  EXPECT_EQ(whole.split(1, 2).index_in_block(), whole.index_in_block());
}

}  // namespace
}  // namespace brume
