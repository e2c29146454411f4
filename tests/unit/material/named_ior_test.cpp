// SPDX-License-Identifier: Apache-2.0
#include "material/named_ior.h"

#include <gtest/gtest.h>

#include "material/fresnel.h"

namespace brume {
namespace {

TEST(NamedIor, EveryListedNameIsFound) {
  for (const std::string_view name : dielectric_names()) {
    ASSERT_TRUE(dielectric_ior(name)) << name;
    EXPECT_GE(*dielectric_ior(name), 1.0f) << name;
  }
  for (const std::string_view name : conductor_names()) {
    ASSERT_TRUE(conductor_ior(name)) << name;
  }
}

TEST(NamedIor, UnknownNamesAreNotFound) {
  EXPECT_FALSE(dielectric_ior("glas"));
  EXPECT_FALSE(dielectric_ior(""));
  EXPECT_FALSE(conductor_ior("cu"));  // symbols are case-sensitive: Co is not CO
}

TEST(NamedIor, DielectricNamesIgnoreCase) {
  EXPECT_EQ(dielectric_ior("BK7"), dielectric_ior("bk7"));
  EXPECT_EQ(dielectric_ior("Diamond"), 2.419f);
}

TEST(NamedIor, MetalsHaveTheirColours) {
  const auto normal = [](std::string_view name) {
    const ConductorIor ior = *conductor_ior(name);
    return fresnel_conductor(1.0f, ior.eta, ior.k);
  };
  EXPECT_EQ(normal("none"), Rgb{1.0f});
  EXPECT_GT(min_component(normal("Ag")), 0.88f);
  EXPECT_GT(min_component(normal("Al")), 0.88f);
  for (const std::string_view warm : {"Au", "Cu"}) {
    EXPECT_GT(normal(warm).r, 0.9f);
    EXPECT_LT(normal(warm).b, 0.6f);
  }
}

}  // namespace
}  // namespace brume
