// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/rgb.h"
#include "io/source_file.h"
#include "io/spectrum.h"

namespace brume {

/// Written as <rgb>: linear Rec. 709.
struct RgbText {
  glm::dvec3 value;
};

/// One <float name="..." value="..."/> and its like.
struct SceneParameter {
  using Value = std::variant<std::int64_t, double, bool, std::string, glm::dvec3, RgbText, Spectrum,
                             glm::dmat4>;
  std::string name;     // as today's dialect spells it
  std::string written;  // as the file spells it
  Value value;
  SourcePosition at;        // of the element
  SourcePosition value_at;  // of its value
};

/// What a colour stands for, which decides its range and how a spectrum becomes one.
enum class ColourUse {
  kReflectance,  // in [0, 1]; spectra are seen under D65
  kEmission,     // >= 0; spectra are the light itself
  kCoefficient,  // >= 0; spectra are seen under D65
};

/// Interval that a number must lie in.
struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool excludes_min = false;
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kNonNegative{.min = 0.0};
inline constexpr NumberRange kPositive{.min = 0.0, .excludes_min = true};

/// An object of the scene file, such as <bsdf type="diffuse" id="white">, with its parameters and
/// the objects inside it or referred to by it. Every question that is asked about a name makes the
/// name valid; `finish` then finds what the file says and nobody asked, and names the nearest valid
/// one. Questions throw an Error with the position when the answer is not what was asked for.
class SceneNode {
 public:
  struct Child {
    std::string name;  // empty when the file gives none
    const SceneNode* node;
    SourcePosition at;  // of the object, or of the <ref> to it
    bool is_reference;
  };

  std::string tag;   // bsdf, shape, ...
  std::string type;  // diffuse, sphere, ...
  std::string id;    // empty when the file gives none
  SourcePosition at;
  SourcePosition type_at;
  bool old_dialect = false;  // written for a version below 2
  // Where files that it names are looked for, in this order; shared by the nodes of a file.
  std::shared_ptr<const std::vector<std::filesystem::path>> search_folders;
  std::vector<SceneParameter> parameters;
  std::vector<Child> children;

  /// `medium "fog"`, or `homogeneous medium` when it has no id.
  std::string label() const;
  [[noreturn]] void fail(const std::string& message) const { fail_at(at, message); }

  /// The parameter of this name, or nullptr.
  const SceneParameter* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// Position of the value of a parameter that is there.
  const SourcePosition& position(std::string_view name) const;
  /// Throws unless the file gives it.
  void require(std::string_view name, std::string_view what) const;

  double number(std::string_view name, double fallback, NumberRange range = kAnyNumber) const;
  std::int64_t integer(std::string_view name, std::int64_t fallback, std::int64_t min,
                       std::int64_t max) const;
  bool boolean(std::string_view name, bool fallback) const;
  std::string text(std::string_view name, const std::string& fallback) const;
  /// One of `valid`, the first of which is the default.
  std::string choice(std::string_view name, const std::vector<std::string>& valid) const;
  glm::dvec3 vec3(std::string_view name, const glm::dvec3& fallback) const;
  /// Affine and invertible; the identity when not given.
  glm::dmat4 transform(std::string_view name) const;
  Rgb colour(std::string_view name, double fallback, ColourUse use) const;
  /// Whether a parameter is given as text, where a number would do too.
  bool is_text(std::string_view name) const;
  /// Path of an existing file that a required parameter names.
  std::filesystem::path file(std::string_view name) const;
  /// The files that were asked for so.
  const std::vector<std::filesystem::path>& files() const { return asked_files_; }

  /// The only child with this tag and name, or nullptr.
  const SceneNode* named_child(std::string_view child_tag, std::string_view name) const;
  /// The children with this tag, whatever their names.
  std::vector<Child> children_of(std::string_view child_tag) const;
  /// The only child with this tag, or nullptr.
  const SceneNode* only_child(std::string_view child_tag) const;

  /// Throws for the first parameter or child that was never asked about.
  void finish() const;

 private:
  template <class Value>
  const Value* find_value(std::string_view name, std::string_view expected) const;
  void finish_child(const Child& child, const std::vector<std::string>& valid) const;

  // Asking is what a const reader does, so the record of it is mutable. One thread reads a scene.
  mutable std::set<std::string, std::less<>> asked_parameters_;
  mutable std::map<std::string, std::string, std::less<>> asked_children_;  // tag by name
  mutable std::set<std::string, std::less<>> asked_tags_;
  mutable std::vector<std::filesystem::path> asked_files_;
};

/// `given` as it stands in the first of `folders` that has it. Throws at `where` when none has.
std::filesystem::path find_file(const std::filesystem::path& given,
                                const std::vector<std::filesystem::path>& folders,
                                const SourcePosition& where);

/// What a parameter was written as, for messages: `<float>`, `<rgb>` ...
std::string_view written_as(const SceneParameter::Value& value);

}  // namespace brume
