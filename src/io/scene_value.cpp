// SPDX-License-Identifier: Apache-2.0
#include "io/scene_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "film/srgb.h"
#include "io/nearest_name.h"
#include "io/number_text.h"
#include "io/transform.h"

namespace brume {
namespace {

const XmlAttribute& attribute(const XmlElement& element, std::string_view name) {
  return *element.find(name);
}

double to_number(const XmlAttribute& a, std::string_view text) {
  if (const auto x = parse_number(text)) return *x;
  fail_at(a.value_at, fmt::format("\"{}\" is not a finite number", text));
}
double to_number(const XmlAttribute& a) {
  return to_number(a, a.value);
}

std::vector<double> to_numbers(const XmlAttribute& a) {
  std::vector<double> numbers;
  for (const std::string_view word : split_words(a.value)) numbers.push_back(to_number(a, word));
  return numbers;
}

glm::dvec3 to_vec3(const XmlAttribute& a) {
  const std::vector<double> v = to_numbers(a);
  if (v.size() != 3) {
    fail_at(a.value_at, fmt::format("expected 3 numbers, found {} in \"{}\"", v.size(), a.value));
  }
  return {v[0], v[1], v[2]};
}

// The attribute `value` of a point, vector or step of a transform: one number stands for three.
glm::dvec3 expanded(const XmlAttribute& a) {
  const std::vector<double> v = to_numbers(a);
  return v.size() == 1 ? glm::dvec3(v[0]) : to_vec3(a);
}

// x, y and z, those left out being `fallback`.
glm::dvec3 components(const XmlElement& element, double fallback) {
  glm::dvec3 v(fallback);
  constexpr std::string_view kNames[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    if (const XmlAttribute* a = element.find(kNames[i])) v[i] = to_number(*a);
  }
  return v;
}

std::int64_t integer_value(const XmlElement& element) {
  check_attributes(element, {"name", "value"});
  const XmlAttribute& a = attribute(element, "value");
  if (const auto value = parse_integer(a.value)) return *value;
  fail_at(a.value_at, fmt::format("\"{}\" is not an integer", a.value));
}

bool boolean_value(const XmlElement& element) {
  check_attributes(element, {"name", "value"});
  const XmlAttribute& a = attribute(element, "value");
  std::string text = a.value;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (text == "true") return true;
  if (text == "false") return false;
  fail_at(a.value_at, fmt::format("\"{}\" is neither true nor false", a.value));
}

glm::dvec3 point_value(const XmlElement& element) {
  if (const XmlAttribute* value = element.find("value")) {
    check_attributes(element, {"name", "value"});
    return expanded(*value);
  }
  check_attributes(element, {"name", "x", "y", "z"});
  return components(element, 0.0);
}

RgbText rgb_value(const XmlElement& element) {
  check_attributes(element, {"name", "value"});
  const XmlAttribute& a = attribute(element, "value");
  if (a.value.starts_with('#')) {
    std::uint32_t code = 0;
    const char* const end = a.value.data() + a.value.size();
    const auto parsed = std::from_chars(a.value.data() + 1, end, code, 16);
    if (a.value.size() != 7 || parsed.ptr != end || parsed.ec != std::errc{}) {
      fail_at(a.value_at, fmt::format("\"{}\" is not a colour #rrggbb", a.value));
    }
    glm::dvec3 c(0.0);
    for (int i = 0; i < 3; ++i)
      c[i] = linear_from_srgb(float((code >> (16 - 8 * i)) & 255) / 255.0f);
    return {c};
  }
  const std::vector<double> v = to_numbers(a);
  if (v.size() == 1) return {glm::dvec3(v[0])};
  if (v.size() == 3) return {glm::dvec3(v[0], v[1], v[2])};
  fail_at(a.value_at, fmt::format("a colour is 1 or 3 numbers or #rrggbb, not \"{}\"", a.value));
}

Spectrum spectrum_value(const XmlElement& element) {
  if (const XmlAttribute* type = element.find("type")) {
    fail_at(type->value_at,
            fmt::format("spectrum plugins such as \"{}\" are not supported; give a number or "
                        "wavelength:value pairs as value, or an <rgb>",
                        type->value));
  }
  check_attributes(element, {"name", "value"});
  const XmlAttribute& a = attribute(element, "value");
  const std::vector<std::string_view> words = split_words(a.value);
  Spectrum spectrum;
  if (words.size() == 1 && words[0].find(':') == std::string_view::npos) {
    spectrum.values.push_back(to_number(a, words[0]));
    return spectrum;
  }
  for (const std::string_view word : words) {
    const std::size_t colon = word.find(':');
    if (colon == std::string_view::npos) {
      fail_at(a.value_at, fmt::format("\"{}\" is not a pair wavelength:value", word));
    }
    const double wavelength_nm = to_number(a, word.substr(0, colon));
    if (!spectrum.wavelengths_nm.empty() && wavelength_nm <= spectrum.wavelengths_nm.back()) {
      fail_at(a.value_at, fmt::format("wavelength {} follows {}; they must increase", wavelength_nm,
                                      spectrum.wavelengths_nm.back()));
    }
    spectrum.wavelengths_nm.push_back(wavelength_nm);
    spectrum.values.push_back(to_number(a, word.substr(colon + 1)));
  }
  if (words.size() < 2) {
    fail_at(a.value_at, "a spectrum is a number or at least two pairs wavelength:value");
  }
  return spectrum;
}

glm::dmat4 translate_step(const XmlElement& e) {
  if (const XmlAttribute* value = e.find("value")) {
    check_attributes(e, {"value"});
    return translation(expanded(*value));
  }
  check_attributes(e, {}, {"x", "y", "z"});
  return translation(components(e, 0.0));
}

glm::dmat4 scale_step(const XmlElement& e) {
  if (const XmlAttribute* value = e.find("value")) {
    check_attributes(e, {"value"});
    return scaling(expanded(*value));
  }
  check_attributes(e, {}, {"x", "y", "z"});
  return scaling(components(e, 1.0));
}

glm::dmat4 rotate_step(const XmlElement& e) {
  glm::dvec3 axis(0.0);
  if (const XmlAttribute* value = e.find("value")) {
    check_attributes(e, {"value", "angle"});
    axis = expanded(*value);
  } else {
    check_attributes(e, {"angle"}, {"x", "y", "z"});
    axis = components(e, 0.0);
  }
  if (axis == glm::dvec3(0.0)) fail_at(e.at, "the axis of a rotation is zero");
  return rotation(axis, to_number(attribute(e, "angle")));
}

glm::dmat4 look_at_step(const XmlElement& e) {
  check_attributes(e, {"origin", "target"}, {"up"});
  const XmlAttribute* up = e.find("up");
  const glm::dmat4 m = look_at(to_vec3(attribute(e, "origin")), to_vec3(attribute(e, "target")),
                               up != nullptr ? to_vec3(*up) : glm::dvec3(0.0));
  if (!std::isfinite(glm::determinant(m))) {
    fail_at(e.at,
            "lookat needs a target apart from its origin and an up that is not along the view");
  }
  return m;
}

glm::dmat4 matrix_step(const XmlElement& e) {
  check_attributes(e, {"value"});
  const XmlAttribute& a = attribute(e, "value");
  const std::vector<double> v = to_numbers(a);
  if (v.size() != 9 && v.size() != 16) {
    fail_at(a.value_at, fmt::format("a matrix has 9 or 16 numbers, not {}", v.size()));
  }
  const int n = v.size() == 9 ? 3 : 4;
  glm::dmat4 m(1.0);
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) m[column][row] = v[std::size_t(row * n + column)];
  }
  if (glm::dvec4(m[0][3], m[1][3], m[2][3], m[3][3]) != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
    fail_at(a.value_at, "the last row of a matrix must be 0 0 0 1");
  }
  return m;
}

struct Step {
  std::string_view tag;
  glm::dmat4 (*matrix)(const XmlElement&);
};
constexpr Step kSteps[] = {{"translate", translate_step},
                           {"rotate", rotate_step},
                           {"scale", scale_step},
                           {"matrix", matrix_step},
                           {"lookat", look_at_step}};

glm::dmat4 transform_value(const XmlElement& element) {
  check_attributes(element, {"name"});
  glm::dmat4 m(1.0);
  for (const XmlElement& child : element.children) {
    const auto step = std::find_if(std::begin(kSteps), std::end(kSteps),
                                   [&](const Step& s) { return s.tag == child.tag; });
    if (step == std::end(kSteps)) {
      std::vector<std::string> valid;
      for (const Step& s : kSteps) valid.emplace_back(s.tag);
      fail_at(child.at, fmt::format("unknown element <{}> in a transform{}", child.tag,
                                    suggestion(child.tag, valid)));
    }
    m = step->matrix(child) * m;
  }
  const double volume = std::abs(glm::determinant(glm::dmat3(m)));
  const bool is_finite = std::isfinite(volume) && std::isfinite(m[3].x + m[3].y + m[3].z);
  if (!is_finite) fail_at(element.at, "the transform is not finite: its numbers are too large");
  if (volume == 0.0) fail_at(element.at, "the transform is singular: it flattens space");
  return m;
}

using Parser = SceneParameter::Value (*)(const XmlElement&);
struct ParameterTag {
  std::string_view tag;
  Parser parse;
};
constexpr ParameterTag kParameterTags[] = {
    {"integer", [](const XmlElement& e) -> SceneParameter::Value { return integer_value(e); }},
    {"float",
     [](const XmlElement& e) -> SceneParameter::Value {
       check_attributes(e, {"name", "value"});
       return to_number(attribute(e, "value"));
     }},
    {"boolean", [](const XmlElement& e) -> SceneParameter::Value { return boolean_value(e); }},
    {"string",
     [](const XmlElement& e) -> SceneParameter::Value {
       check_attributes(e, {"name", "value"});
       return attribute(e, "value").value;
     }},
    {"point", [](const XmlElement& e) -> SceneParameter::Value { return point_value(e); }},
    {"vector", [](const XmlElement& e) -> SceneParameter::Value { return point_value(e); }},
    {"rgb", [](const XmlElement& e) -> SceneParameter::Value { return rgb_value(e); }},
    {"spectrum", [](const XmlElement& e) -> SceneParameter::Value { return spectrum_value(e); }},
    {"transform", [](const XmlElement& e) -> SceneParameter::Value { return transform_value(e); }},
};

const ParameterTag* find_tag(std::string_view tag) {
  const auto found = std::find_if(std::begin(kParameterTags), std::end(kParameterTags),
                                  [&](const ParameterTag& p) { return p.tag == tag; });
  return found == std::end(kParameterTags) ? nullptr : found;
}

}  // namespace

void check_attributes(const XmlElement& element, std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional) {
  std::vector<std::string> valid(required.begin(), required.end());
  valid.insert(valid.end(), optional.begin(), optional.end());
  for (const XmlAttribute& a : element.attributes) {
    if (std::find(valid.begin(), valid.end(), a.name) == valid.end()) {
      fail_at(a.at, fmt::format("unknown attribute \"{}\" of <{}>{}", a.name, element.tag,
                                suggestion(a.name, valid)));
    }
  }
  for (const std::string_view name : required) {
    if (element.find(name) == nullptr) {
      fail_at(element.at, fmt::format("<{}> needs the attribute \"{}\"", element.tag, name));
    }
  }
}

bool is_parameter_tag(std::string_view tag) {
  return find_tag(tag) != nullptr;
}

SceneParameter::Value parse_value(const XmlElement& element) {
  return find_tag(element.tag)->parse(element);
}

}  // namespace brume
