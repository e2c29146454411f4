// SPDX-License-Identifier: Apache-2.0
#include "io/scene_node.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/nearest_name.h"

namespace brume {
namespace {

std::string describe(const NumberRange& range) {
  if (std::isinf(range.max)) {
    if (std::isinf(range.min)) return "finite";
    if (range.min == 0.0) return range.excludes_min ? "positive" : "at least 0";
    return fmt::format("{} {}", range.excludes_min ? "above" : "at least", range.min);
  }
  return fmt::format("in {}{}, {}]", range.excludes_min ? '(' : '[', range.min, range.max);
}

bool contains(const NumberRange& range, double x) {
  return (range.excludes_min ? x > range.min : x >= range.min) && x <= range.max;
}

/// Throws unless the number `x`, a part of parameter `p`, is in range and a float can hold it.
void require_within(const NumberRange& range, double x, const SceneParameter& p,
                    const std::string& label) {
  const bool too_large = std::abs(x) > double(std::numeric_limits<float>::max());
  if (contains(range, x) && !too_large) return;
  fail_at(p.value_at, fmt::format("parameter \"{}\" of {} is {}, {}", p.written, label, x,
                                  contains(range, x) ? "beyond single precision (3.4e38)"
                                                     : "but must be " + describe(range)));
}

}  // namespace

std::filesystem::path find_file(const std::filesystem::path& given,
                                const std::vector<std::filesystem::path>& folders,
                                const SourcePosition& where) {
  if (given.empty()) fail_at(where, "the path of a file is empty");
  std::error_code ignored;
  std::vector<std::string> tried;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path candidate = folder.empty() ? given : folder / given;
    if (std::filesystem::exists(candidate, ignored)) return candidate;
    const std::string name = folder.empty() ? "." : folder.string();
    if (std::find(tried.begin(), tried.end(), name) == tried.end()) tried.push_back(name);
  }
  fail_at(where, given.is_absolute() ? fmt::format("there is no file \"{}\"", given.string())
                                     : fmt::format("there is no file \"{}\" (looked in {})",
                                                   given.string(), fmt::join(tried, ", ")));
}

std::string_view written_as(const SceneParameter::Value& value) {
  constexpr std::string_view kTags[] = {"<integer>", "<float>", "<boolean>",  "<string>",
                                        "<point>",   "<rgb>",   "<spectrum>", "<transform>"};
  static_assert(std::size(kTags) == std::variant_size_v<SceneParameter::Value>);
  return kTags[value.index()];
}

std::string SceneNode::label() const {
  if (!id.empty()) return fmt::format("{} \"{}\"", tag, id);
  return type.empty() ? tag : fmt::format("{} {}", type, tag);
}

const SceneParameter* SceneNode::find(std::string_view name) const {
  asked_parameters_.emplace(name);
  for (const SceneParameter& p : parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

template <class Value>
const Value* SceneNode::find_value(std::string_view name, std::string_view expected) const {
  const SceneParameter* p = find(name);
  if (p == nullptr) return nullptr;
  const Value* value = std::get_if<Value>(&p->value);
  if (value == nullptr) {
    fail_at(p->at, fmt::format("parameter \"{}\" of {} is {}, not {}", p->written, label(),
                               written_as(p->value), expected));
  }
  return value;
}

const SourcePosition& SceneNode::position(std::string_view name) const {
  const SceneParameter* p = find(name);
  return p != nullptr ? p->value_at : at;
}

void SceneNode::require(std::string_view name, std::string_view what) const {
  if (!has(name)) fail(fmt::format("{} needs the parameter \"{}\" ({})", label(), name, what));
}

double SceneNode::number(std::string_view name, double fallback, NumberRange range) const {
  const SceneParameter* p = find(name);
  if (p == nullptr) return fallback;
  double x = 0.0;
  if (const auto* integer = std::get_if<std::int64_t>(&p->value)) {
    x = double(*integer);
  } else {
    x = *find_value<double>(name, "a number");
  }
  require_within(range, x, *p, label());
  return x;
}

std::int64_t SceneNode::integer(std::string_view name, std::int64_t fallback, std::int64_t min,
                                std::int64_t max) const {
  const std::int64_t* value = find_value<std::int64_t>(name, "<integer>");
  if (value == nullptr) return fallback;
  if (*value < min || *value > max) {
    fail_at(position(name), fmt::format("parameter \"{}\" of {} is {}, but must be in [{}, {}]",
                                        find(name)->written, label(), *value, min, max));
  }
  return *value;
}

bool SceneNode::boolean(std::string_view name, bool fallback) const {
  const bool* value = find_value<bool>(name, "<boolean>");
  return value != nullptr ? *value : fallback;
}

std::string SceneNode::text(std::string_view name, const std::string& fallback) const {
  const std::string* value = find_value<std::string>(name, "<string>");
  return value != nullptr ? *value : fallback;
}

std::string SceneNode::choice(std::string_view name, const std::vector<std::string>& valid) const {
  const std::string value = text(name, valid.front());
  if (std::find(valid.begin(), valid.end(), value) == valid.end()) {
    fail_at(position(name), fmt::format("parameter \"{}\" of {} is \"{}\"{}", find(name)->written,
                                        label(), value, suggestion(value, valid)));
  }
  return value;
}

glm::dvec3 SceneNode::vec3(std::string_view name, const glm::dvec3& fallback) const {
  const glm::dvec3* value = find_value<glm::dvec3>(name, "<point> or <vector>");
  return value != nullptr ? *value : fallback;
}

glm::dmat4 SceneNode::transform(std::string_view name) const {
  const glm::dmat4* value = find_value<glm::dmat4>(name, "<transform>");
  return value != nullptr ? *value : glm::dmat4(1.0);
}

Rgb SceneNode::colour(std::string_view name, double fallback, ColourUse use) const {
  const SceneParameter* p = find(name);
  if (p == nullptr) return Rgb(float(fallback));

  glm::dvec3 c(0.0);
  if (const auto* rgb = std::get_if<RgbText>(&p->value)) {
    c = rgb->value;
  } else if (const auto* spectrum = std::get_if<Spectrum>(&p->value)) {
    // Older scenes mean grey by a single number for a light; since version 2 it is equal energy.
    const bool is_light = use == ColourUse::kEmission && !(old_dialect && spectrum->is_uniform());
    c = is_light ? emission_to_rgb(*spectrum) : reflectance_to_rgb(*spectrum);
    if (std::any_of(spectrum->values.begin(), spectrum->values.end(),
                    [](double v) { return v < 0.0; })) {
      fail_at(p->value_at,
              fmt::format("spectrum \"{}\" of {} is negative somewhere", p->written, label()));
    }
    // Real spectra may lie outside the gamut of Rec. 709.
    c = glm::max(c, glm::dvec3(0.0));
    if (use == ColourUse::kReflectance && !spectrum->is_uniform()) c = glm::min(c, glm::dvec3(1.0));
  } else if (const auto* integer = std::get_if<std::int64_t>(&p->value)) {
    c = glm::dvec3(double(*integer));
  } else {
    c = glm::dvec3(*find_value<double>(name, "a number, <rgb> or <spectrum>"));
  }

  const NumberRange range =
      use == ColourUse::kReflectance ? NumberRange{.min = 0.0, .max = 1.0} : kNonNegative;
  for (int i = 0; i < 3; ++i) require_within(range, c[i], *p, label());
  return Rgb(c);
}

bool SceneNode::is_text(std::string_view name) const {
  const SceneParameter* p = find(name);
  return p != nullptr && std::holds_alternative<std::string>(p->value);
}

std::filesystem::path SceneNode::file(std::string_view name) const {
  require(name, "path of a file");
  return asked_files_.emplace_back(find_file(text(name, ""), *search_folders, position(name)));
}

const SceneNode* SceneNode::named_child(std::string_view child_tag, std::string_view name) const {
  asked_children_.emplace(name, child_tag);
  for (const Child& c : children) {
    if (c.name == name && c.node->tag == child_tag) return c.node;
  }
  return nullptr;
}

std::vector<SceneNode::Child> SceneNode::children_of(std::string_view child_tag) const {
  asked_tags_.emplace(child_tag);
  std::vector<Child> result;
  std::copy_if(children.begin(), children.end(), std::back_inserter(result),
               [&](const Child& c) { return c.node->tag == child_tag; });
  return result;
}

const SceneNode* SceneNode::only_child(std::string_view child_tag) const {
  const std::vector<Child> found = children_of(child_tag);
  if (found.size() > 1) {
    fail_at(found[1].at, fmt::format("{} has a second <{}>; one is expected", label(), child_tag));
  }
  return found.empty() ? nullptr : found.front().node;
}

void SceneNode::finish() const {
  std::set<std::string> names(asked_parameters_.begin(), asked_parameters_.end());
  for (const auto& [name, child_tag] : asked_children_) names.insert(name);
  const std::vector<std::string> valid(names.begin(), names.end());
  for (const SceneParameter& p : parameters) {
    if (asked_parameters_.contains(p.name)) continue;
    if (const auto asked = asked_children_.find(p.name); asked != asked_children_.end()) {
      fail_at(p.at, fmt::format("parameter \"{}\" of {} is {}, not <{}>", p.written, label(),
                                written_as(p.value), asked->second));
    }
    fail_at(p.at, fmt::format("unknown parameter \"{}\" of {}{}", p.written, label(),
                              suggestion(p.name, valid)));
  }
  for (const Child& c : children) {
    if (!asked_tags_.contains(c.node->tag)) finish_child(c, valid);
  }
}

void SceneNode::finish_child(const Child& child, const std::vector<std::string>& valid) const {
  const std::string& child_tag = child.node->tag;
  if (child.name.empty()) {
    fail_at(child.at, fmt::format("a <{}> does not belong in {}", child_tag, label()));
  }
  const auto asked = asked_children_.find(child.name);
  if (asked != asked_children_.end() && asked->second == child_tag) return;
  if (asked != asked_children_.end() || asked_parameters_.contains(child.name)) {
    fail_at(child.at, fmt::format("\"{}\" of {} cannot be a <{}>", child.name, label(), child_tag));
  }
  fail_at(child.at, fmt::format("unknown parameter \"{}\" of {}{}", child.name, label(),
                                suggestion(child.name, valid)));
}

}  // namespace brume
