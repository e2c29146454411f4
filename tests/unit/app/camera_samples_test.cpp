// SPDX-License-Identifier: Apache-2.0
#include "app/camera_samples.h"

#include <gtest/gtest.h>

#include <set>

namespace brume {
namespace {

constexpr std::uint32_t kSpacing = kLightPathSpacing;

/// Whatever blocks they are at: what one gets is decided by the noise of those around it.
TEST(LightPathGroup, PixelsNearEachOtherNeverShareOne) {
  for (const std::uint32_t sets_across : {1u, 2u}) {
    const auto groups = [&](std::uint32_t column, std::uint32_t row) {
      std::set<std::uint32_t> result;
      for (std::uint32_t block = 0; block < 20; ++block)
        result.insert(light_path_group(column, row, block, sets_across));
      return result;
    };
    const std::set<std::uint32_t> own = groups(30, 25);
    EXPECT_EQ(own.size(), sets_across * sets_across);
    for (std::uint32_t row = 25 - kSpacing + 1; row < 25 + kSpacing; ++row)
      for (std::uint32_t column = 30 - kSpacing + 1; column < 30 + kSpacing; ++column) {
        if (column == 30 && row == 25) continue;
        for (const std::uint32_t group : groups(column, row))
          EXPECT_FALSE(own.contains(group)) << column << ", " << row;
      }
    EXPECT_EQ(groups(30 + kSpacing, 25 - kSpacing), own);
  }
}

TEST(LightPathGroup, BlocksOfATurnMeetDifferentOnes) {
  for (std::uint32_t first = 0; first < 10; ++first) {
    std::set<std::uint32_t> groups;
    for (std::uint32_t block = first; block < first + 4; ++block)
      groups.insert(light_path_group(7, 11, block, 2));
    EXPECT_EQ(groups.size(), 4u);
    EXPECT_LT(*groups.rbegin(), LightPaths::kGroups);
  }
}

}  // namespace
}  // namespace brume
