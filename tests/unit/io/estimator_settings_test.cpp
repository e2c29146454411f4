// SPDX-License-Identifier: Apache-2.0
#include "io/estimator_settings.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace brume {
namespace {

using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::string refusal(const std::string& assignment) {
  EstimatorSettings settings;
  try {
    apply_setting(assignment, settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(EstimatorSettings, EverySettingTakesItsDefaultAndItsTextbookValue) {
  const EstimatorSettings defaults;
  EXPECT_THAT(changed_settings(defaults), IsEmpty());
  for (const Setting& setting : setting_table()) {
    EstimatorSettings settings;
    apply_setting(setting.name + "=" + setting.value(defaults), settings);
    EXPECT_THAT(changed_settings(settings), IsEmpty()) << setting.name;
    if (setting.textbook.empty()) continue;
    apply_setting(setting.name + "=" + setting.textbook, settings);
    EXPECT_EQ(setting.value(settings), setting.textbook);
  }
}

TEST(EstimatorSettings, TextbookIsPlainTrackingWithoutBias) {
  EstimatorSettings settings;
  apply_setting("textbook", settings);
  EXPECT_EQ(settings.tracking.bounds, TrackingSettings::Bounds::kGlobal);
  EXPECT_EQ(settings.tracking.lookup, TrackingSettings::Lookup::kTrilinear);
  EXPECT_FALSE(settings.tracking.control);
  EXPECT_FALSE(settings.tracking.roulette);
  EXPECT_FALSE(settings.lighting.near_lights);
  EXPECT_FALSE(settings.lighting.light_paths);
  EXPECT_FALSE(settings.lighting.shadow_roulette);
  EXPECT_EQ(settings.numbers, EstimatorSettings::Numbers::kIndependent);
  EXPECT_THAT(biased_settings(settings), IsEmpty());
}

TEST(EstimatorSettings, BiasIsDeclaredByValue) {
  for (const auto& [assignment, value] :
       {std::pair("lookup=nearest", "nearest"), std::pair("march=0.5", "0.5"),
        std::pair("storage=half", "half"), std::pair("storage=8bit", "8bit"),
        std::pair("similarity=16", "16"), std::pair("clamp=2.5", "2.5")}) {
    EstimatorSettings settings;
    apply_setting(assignment, settings);
    const std::string text = assignment;
    const SettingValues expected = {{text.substr(0, text.find('=')), value}};
    EXPECT_EQ(changed_settings(settings), expected);
    EXPECT_EQ(biased_settings(settings), expected);
    const std::string& name = expected.front().first;
    apply_setting(name == "lookup"    ? "lookup=trilinear"
                  : name == "storage" ? "storage=float"
                                      : name + "=off",
                  settings);
    EXPECT_THAT(biased_settings(settings), IsEmpty());
  }
}

TEST(EstimatorSettings, ALaterAssignmentReplacesAnEarlierOne) {
  EstimatorSettings settings;
  for (const char* assignment :
       {"textbook", "control=on", "roulette=on", "lookup=stochastic", "bounds=cells",
        "near-lights=on", "light-paths=on", "shadow-roulette=on"})
    apply_setting(assignment, settings);
  EXPECT_THAT(changed_settings(settings),
              UnorderedElementsAre(std::pair("sampler", "independent")));
}

TEST(EstimatorSettings, UnknownNamesAndValuesAreRefusedWithTheValidOnes) {
  EXPECT_EQ(refusal("bonds=global"),
            "--set bonds=global: no setting has this name; did you mean \"bounds\"?");
  EXPECT_EQ(refusal("textbok"),
            "--set textbok: no setting has this name; did you mean \"textbook\"?");
  EXPECT_EQ(refusal("bounds=glob"),
            "--set bounds=glob: \"glob\" is no value of bounds; expected cells, global");
  for (const char* number : {"0", "-1", "nan", "1x", ""})
    EXPECT_EQ(refusal(std::string("march=") + number),
              std::string("--set march=") + number + ": \"" + number +
                  "\" is no value of march; expected off, a number of voxels from 0.01 (biased)");
  EXPECT_EQ(refusal("bounds"), "--set bounds: \"\" is no value of bounds; expected cells, global");
}

}  // namespace
}  // namespace brume
