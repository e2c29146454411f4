// SPDX-License-Identifier: Apache-2.0
#include "io/estimator_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/error.h"
#include "io/nearest_name.h"

namespace brume {
namespace {

/// Values of a setting by name, the default first.
template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

const Choices<bool> kOnOff = {{"on", true}, {"off", false}};

template <class T>
std::string joined_names(const Choices<T>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) names += names.empty() ? name : ", " + name;
  return names;
}

/// A setting without bias with the given values; the last one is the textbook's. `Field` refers to
/// it within EstimatorSettings, const or not.
template <class T, class Field>
Setting unbiased_choice(std::string name, Choices<T> choices, std::string meaning, Field field) {
  return {.name = std::move(name),
          .values = joined_names(choices),
          .textbook = choices.back().first,
          .meaning = std::move(meaning),
          .value =
              [choices, field](const EstimatorSettings& settings) {
                const auto chosen =
                    std::find_if(choices.begin(), choices.end(),
                                 [&](const auto& c) { return c.second == field(settings); });
                return chosen->first;
              },
          .is_biased = [](const EstimatorSettings&) { return false; },
          .assign =
              [choices, field](EstimatorSettings& settings, const std::string& word) {
                const auto chosen = std::find_if(choices.begin(), choices.end(),
                                                 [&](const auto& c) { return c.first == word; });
                if (chosen == choices.end()) return false;
                field(settings) = chosen->second;
                return true;
              }};
}

/// `setting` with one more value, which is biased.
template <class T, class Field>
Setting with_biased_value(Setting setting, const std::string& word, T value, Field field) {
  const auto is_this = [field, value](const EstimatorSettings& s) { return field(s) == value; };
  const auto was_biased = setting.is_biased;
  setting.values += ", " + word + " (biased)";
  setting.value = [=, name = setting.value](const EstimatorSettings& s) {
    return is_this(s) ? word : name(s);
  };
  setting.is_biased = [=](const EstimatorSettings& s) { return is_this(s) || was_biased(s); };
  setting.assign = [=, assign = setting.assign](EstimatorSettings& s, const std::string& given) {
    if (given != word) return assign(s, given);
    field(s) = value;
    return true;
  };
  return setting;
}

/// A setting that is off or a number of `T` in [least, most], and then biased.
template <class T, class Field>
Setting biased_number(std::string name, std::string unit, std::string meaning, T off, T least,
                      T most, Field field) {
  return {.name = std::move(name),
          .values = fmt::format("off, {} (biased)", unit),
          .textbook = {},
          .meaning = std::move(meaning),
          .value =
              [off, field](const EstimatorSettings& s) {
                return field(s) == off ? std::string("off") : fmt::format("{}", field(s));
              },
          .is_biased = [off, field](const EstimatorSettings& s) { return field(s) != off; },
          .assign =
              [off, least, most, field](EstimatorSettings& s, const std::string& word) {
                T value = off;
                const char* end = word.data() + word.size();
                const auto [rest, error] = std::from_chars(word.data(), end, value);
                const bool is_number = error == std::errc{} && rest == end;
                if (word == "off")
                  value = off;
                else if (!is_number || !(value >= least && value <= most))
                  return false;
                field(s) = value;
                return true;
              }};
}

std::vector<Setting> make_table() {
  using Bounds = TrackingSettings::Bounds;
  using Lookup = TrackingSettings::Lookup;
  using Storage = TrackingSettings::Storage;
  using Numbers = EstimatorSettings::Numbers;
  const auto lookup = [](auto& s) -> auto& {
    return s.tracking.lookup;
  };
  const auto storage = [](auto& s) -> auto& {
    return s.tracking.storage;
  };
  constexpr float kLargest = std::numeric_limits<float>::max();
  return {
      unbiased_choice(
          "bounds", Choices<Bounds>{{"cells", Bounds::kCells}, {"global", Bounds::kGlobal}},
          "majorants of grids: one for each cell of a few voxels, or one for the whole grid",
          [](auto& s) -> auto& { return s.tracking.bounds; }),
      with_biased_value(
          unbiased_choice("lookup",
                          Choices<Lookup>{{"stochastic", Lookup::kStochastic},
                                          {"trilinear", Lookup::kTrilinear}},
                          "interpolation at collisions: one voxel drawn by its weight, all eight, "
                          "or none",
                          lookup),
          "nearest", Lookup::kNearest, lookup),
      unbiased_choice(
          "control", kOnOff, "the minimum of a cell is passed in closed form, without lookups",
          [](auto& s) -> auto& { return s.tracking.control; }),
      unbiased_choice(
          "roulette", kOnOff, "estimates of transmittance end early once they have become small",
          [](auto& s) -> auto& { return s.tracking.roulette; }),
      unbiased_choice(
          "near-lights", kOnOff, "flights also look for light at their points close to lamps",
          [](auto& s) -> auto& { return s.lighting.near_lights; }),
      unbiased_choice(
          "light-paths", kOnOff,
          "light is followed from the lamps, where all lights are lamps, and met by the paths",
          [](auto& s) -> auto& { return s.lighting.light_paths; }),
      unbiased_choice(
          "shadow-roulette", kOnOff,
          "fewer shadow rays into directions that little light is scattered to",
          [](auto& s) -> auto& { return s.lighting.shadow_roulette; }),
      unbiased_choice(
          "sampler",
          Choices<Numbers>{{"sobol", Numbers::kSobol}, {"independent", Numbers::kIndependent}},
          "random numbers: Owen-scrambled Sobol points, or independent ones",
          [](auto& s) -> auto& { return s.numbers; }),
      with_biased_value(
          with_biased_value(
              unbiased_choice("storage", Choices<Storage>{{"float", Storage::kFloat}},
                              "voxels of scalar grids in memory: 32, 16 or 8 bits", storage),
              "half", Storage::k16Bit, storage),
          "8bit", Storage::k8Bit, storage),
      biased_number(
          "march", "a number of voxels from 0.01",
          "grids are crossed in steps of this length instead of by null collisions", 0.0f, 0.01f,
          kLargest, [](auto& s) -> auto& { return s.tracking.march_step; }),
      biased_number(
          "similarity", "a number of scatterings from 1",
          "light that has scattered so often sees isotropic media that spread it as far",
          Approximations{}.similarity, 1, 1'000'000'000,
          [](auto& s) -> auto& { return s.approximations.similarity; }),
      biased_number(
          "clamp", "a radiance > 0",
          "light that scattered more than once adds no more than this at a time",
          Approximations{}.clamp, std::numeric_limits<float>::min(), kLargest,
          [](auto& s) -> auto& { return s.approximations.clamp; }),
  };
}

/// The setting that "name=value" names.
const Setting& find_setting(const std::string& assignment) {
  const std::string name = assignment.substr(0, assignment.find('='));
  const std::vector<Setting>& table = setting_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Setting& s) { return s.name == name; });
  if (found != table.end()) return *found;
  std::vector<std::string> names = {"textbook"};
  for (const Setting& setting : table) names.push_back(setting.name);
  throw Error(
      fmt::format("--set {}: no setting has this name{}", assignment, suggestion(name, names)));
}

}  // namespace

const std::vector<Setting>& setting_table() {
  static const std::vector<Setting> table = make_table();
  return table;
}

TrackingSettings media_settings(const EstimatorSettings& settings) {
  TrackingSettings tracking = settings.tracking;
  tracking.similar_media = settings.approximations.similarity != Approximations{}.similarity;
  return tracking;
}

void apply_setting(const std::string& assignment, EstimatorSettings& settings) {
  if (assignment == "textbook") {
    for (const Setting& setting : setting_table())
      if (!setting.textbook.empty()) setting.assign(settings, setting.textbook);
    return;
  }
  const std::size_t equals = assignment.find('=');
  const Setting& setting = find_setting(assignment);
  const std::string word = equals == std::string::npos ? "" : assignment.substr(equals + 1);
  if (!setting.assign(settings, word))
    throw Error(fmt::format("--set {}: \"{}\" is no value of {}; expected {}", assignment, word,
                            setting.name, setting.values));
}

SettingValues changed_settings(const EstimatorSettings& settings) {
  const EstimatorSettings defaults;
  SettingValues changed;
  for (const Setting& setting : setting_table())
    if (setting.value(settings) != setting.value(defaults))
      changed.emplace_back(setting.name, setting.value(settings));
  return changed;
}

SettingValues biased_settings(const EstimatorSettings& settings) {
  SettingValues values = changed_settings(settings);
  std::erase_if(values, [&](const auto& v) { return !find_setting(v.first).is_biased(settings); });
  return values;
}

}  // namespace brume
