// SPDX-License-Identifier: Apache-2.0
#include "io/scene_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "io/nearest_name.h"
#include "io/scene_value.h"
#include "io/xml_document.h"

namespace brume {
namespace {

const std::vector<std::string> kObjectTags = {"integrator", "sensor", "sampler", "film",
                                              "rfilter",    "shape",  "bsdf",    "texture",
                                              "emitter",    "medium", "phase",   "volume"};

constexpr std::size_t kMaxIncludes = 16;
constexpr int kMaxReferences = 64;

bool is_object_tag(const std::string& tag) {
  return std::find(kObjectTags.begin(), kObjectTags.end(), tag) != kObjectTags.end();
}

std::vector<std::string> valid_tags() {
  std::vector<std::string> tags = kObjectTags;
  for (const char* other :
       {"integer", "float", "boolean", "string", "point", "vector", "rgb", "spectrum", "transform",
        "ref", "include", "default", "alias", "path"}) {
    tags.emplace_back(other);
  }
  return tags;
}

// sigmaT to sigma_t, intIOR to int_ior: the names of versions before 2.
std::string snake_case(const std::string& camel_case) {
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  std::string result;
  for (std::size_t i = 0; i < camel_case.size(); ++i) {
    const char c = camel_case[i];
    const bool follows_upper = i > 0 && is_upper(camel_case[i - 1]);
    if (is_upper(c) && i > 0 && !follows_upper && camel_case[i - 1] != '_') result += '_';
    result += is_upper(c) ? char(c - 'A' + 'a') : c;
  }
  return result;
}

bool is_old_version(const XmlElement& root) {
  const XmlAttribute* version = root.find("version");
  if (version == nullptr) {
    fail_at(root.at,
            fmt::format("<{}> needs the attribute \"version\", such as \"3.0.0\"", root.tag));
  }
  const std::string& text = version->value;
  if (text.empty() || text.find_first_not_of("0123456789.") != std::string::npos ||
      text[0] == '.') {
    fail_at(version->value_at,
            fmt::format("\"{}\" is not a version number, such as \"3.0.0\"", text));
  }
  return text == "0" || text == "1" || text.starts_with("0.") || text.starts_with("1.");
}

class DocumentReader {
 public:
  explicit DocumentReader(const Definitions& definitions) {
    for (const auto& [name, value] : definitions) {
      parameters_[name] = {.value = value, .is_used = false};
    }
  }

  SceneDocument read(const std::filesystem::path& path) {
    const XmlElement root = open(path);
    if (root.tag != "scene") {
      fail_at(root.at,
              fmt::format("the root element is <{}>; a scene file begins with <scene>", root.tag));
    }
    const File file = file_of(root, path, {std::filesystem::path()});
    document_.root = read_object(root, file, nullptr);
    resolve_references();
    for (const auto& node : document_.nodes) check_cycles(*node, 0);
    check_definitions(path);
    return std::move(document_);
  }

 private:
  using Folders = std::vector<std::filesystem::path>;

  // What is the same for all elements of one file.
  struct File {
    std::shared_ptr<Folders> folders;
    bool old_dialect;
  };
  struct Parameter {
    std::string value;
    bool is_used;
  };
  struct PendingReference {
    SceneNode* parent;
    std::size_t child;
    std::string id;
    SourcePosition id_at;
  };

  XmlElement open(const std::filesystem::path& path) {
    std::error_code failed;
    const std::filesystem::path resolved = std::filesystem::weakly_canonical(path, failed);
    open_files_.push_back(failed ? path : resolved);
    document_.files.push_back(path);
    return read_xml(path);
  }

  File file_of(const XmlElement& root, const std::filesystem::path& path, const Folders& outer) {
    const auto folders = std::make_shared<Folders>(outer);
    folders->insert(folders->begin(), path.parent_path());
    return {.folders = folders, .old_dialect = is_old_version(root)};
  }

  // $name in an attribute: the longest known name that follows the sign.
  std::string substituted(const XmlAttribute& a) {
    std::string result;
    std::size_t at = 0;
    for (std::size_t sign; (sign = a.value.find('$', at)) != std::string::npos;) {
      result.append(a.value, at, sign - at);
      const std::string_view rest = std::string_view(a.value).substr(sign + 1);
      std::pair<const std::string, Parameter>* best = nullptr;
      for (auto& entry : parameters_) {
        const bool is_longer = best == nullptr || entry.first.size() > best->first.size();
        if (is_longer && rest.starts_with(entry.first)) best = &entry;
      }
      if (best == nullptr) fail_undefined(a, rest);
      best->second.is_used = true;
      result += best->second.value;
      at = sign + 1 + best->first.size();
    }
    return result.append(a.value, at);
  }

  [[noreturn]] void fail_undefined(const XmlAttribute& a, std::string_view rest) const {
    const auto end = std::find_if_not(
        rest.begin(), rest.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    const std::string name(rest.begin(), end);
    std::vector<std::string> known;
    for (const auto& entry : parameters_) known.push_back(entry.first);
    const std::string nearest = nearest_name(name, known);
    fail_at(a.value_at,
            nearest.empty()
                ? fmt::format("the parameter \"${0}\" has no value; give it one with -D {0}=... or "
                              "<default name=\"{0}\" value=\"...\"/> before this line",
                              name)
                : fmt::format("the parameter \"${}\" has no value; did you mean \"${}\"?", name,
                              nearest));
  }

  // The element with $name replaced in its attributes, and in its children if it is a transform;
  // other children are left out.
  XmlElement with_values(const XmlElement& raw, const File& file) {
    XmlElement result{.tag = raw.tag, .attributes = raw.attributes, .at = raw.at};
    if (file.old_dialect && result.tag == "lookAt") result.tag = "lookat";
    for (XmlAttribute& a : result.attributes) a.value = substituted(a);
    if (raw.tag == "transform") {
      for (const XmlElement& child : raw.children) {
        if (!child.children.empty()) fail_children(child);
        result.children.push_back(with_values(child, file));
      }
    }
    return result;
  }

  [[noreturn]] static void fail_children(const XmlElement& element) {
    fail_at(element.children[0].at, fmt::format("<{}> has no elements inside", element.tag));
  }

  SceneNode* read_object(const XmlElement& raw, const File& file, SceneNode* parent) {
    const XmlElement element = with_values(raw, file);
    document_.nodes.push_back(std::make_unique<SceneNode>());
    SceneNode* node = document_.nodes.back().get();
    node->tag = element.tag;
    node->at = element.at;
    node->old_dialect = file.old_dialect;
    node->search_folders = file.folders;
    if (element.tag == "scene") {
      check_attributes(element, {"version"}, {"id", "name"});
    } else {
      // The root of an included file has a version too.
      const bool is_file_root = raw.find("version") != nullptr && parent == nullptr;
      if (is_file_root) {
        check_attributes(element, {"type", "version"}, {"id", "name"});
      } else {
        check_attributes(element, {"type"}, {"id", "name"});
      }
      node->type = element.find("type")->value;
      node->type_at = element.find("type")->value_at;
    }
    if (const XmlAttribute* id = element.find("id")) declare(id->value, node, id->value_at);
    for (const XmlElement& child : raw.children) read_child(child, file, node);
    return node;
  }

  void declare(const std::string& id, SceneNode* node, const SourcePosition& at) {
    if (const auto [first, is_new] = ids_.emplace(id, node); !is_new) {
      fail_at(at, fmt::format("the id \"{}\" is taken: {}", id, first->second->at.to_string()));
    }
    if (node->id.empty()) node->id = id;
  }

  void read_child(const XmlElement& raw, const File& file, SceneNode* parent) {
    if (is_object_tag(raw.tag)) {
      const std::size_t child = add_child(raw, file, parent, raw.at, false);
      parent->children[child].node = read_object(raw, file, parent);
      return;
    }
    const XmlElement element = with_values(raw, file);
    if (element.tag != "transform" && !raw.children.empty()) fail_children(raw);
    if (is_parameter_tag(element.tag)) {
      read_parameter(element, file, parent);
    } else if (element.tag == "ref") {
      check_attributes(element, {"id"}, {"name"});
      const XmlAttribute& id = *element.find("id");
      const std::size_t child = add_child(element, file, parent, element.at, true);
      pending_.push_back({parent, child, id.value, id.value_at});
    } else if (element.tag == "include") {
      read_include(element, file, parent);
    } else if (element.tag == "default") {
      check_attributes(element, {"name", "value"});
      parameters_
          .emplace(element.find("name")->value,
                   Parameter{.value = element.find("value")->value, .is_used = true})
          .first->second.is_used = true;
    } else if (element.tag == "alias") {
      read_alias(element);
    } else if (element.tag == "path") {
      check_attributes(element, {"value"});
      if (parent->tag != "scene") fail_at(element.at, "<path> belongs directly in <scene>");
      const XmlAttribute& value = *element.find("value");
      file.folders->insert(file.folders->begin(),
                           find_file(value.value, *file.folders, value.value_at));
    } else {
      fail_at(element.at, fmt::format("unknown element <{}>{}", element.tag,
                                      suggestion(element.tag, valid_tags())));
    }
  }

  static std::string name_of(const XmlElement& element, const File& file) {
    const XmlAttribute* name = element.find("name");
    if (name == nullptr) return {};
    return file.old_dialect ? snake_case(name->value) : name->value;
  }

  // Throws when `parent` has a parameter or child of that name already.
  static void check_name_is_new(const SceneNode& parent, const std::string& name,
                                const SourcePosition& at) {
    if (name.empty()) return;
    SourcePosition first;
    for (const SceneParameter& p : parent.parameters) {
      if (p.name == name) first = p.at;
    }
    for (const SceneNode::Child& c : parent.children) {
      if (c.name == name) first = c.at;
    }
    if (first.file == nullptr) return;
    fail_at(at, fmt::format("parameter \"{}\" of {} is given twice; first at {}", name,
                            parent.label(), first.to_string()));
  }

  std::size_t add_child(const XmlElement& raw, const File& file, SceneNode* parent,
                        const SourcePosition& at, bool is_reference) {
    const std::string name = name_of(with_values(raw, file), file);
    check_name_is_new(*parent, name, at);
    parent->children.push_back(
        {.name = name, .node = nullptr, .at = at, .is_reference = is_reference});
    return parent->children.size() - 1;
  }

  void read_parameter(const XmlElement& element, const File& file, SceneNode* parent) {
    SceneParameter::Value value = parse_value(element);
    const std::string name = name_of(element, file);
    check_name_is_new(*parent, name, element.at);
    // A transform has no value; what is wrong with it is told where it begins.
    const XmlAttribute* text = element.find("value");
    parent->parameters.push_back({.name = name,
                                  .written = element.find("name")->value,
                                  .value = std::move(value),
                                  .at = element.at,
                                  .value_at = text != nullptr ? text->value_at : element.at});
  }

  void read_alias(const XmlElement& element) {
    check_attributes(element, {"id", "as"});
    const XmlAttribute& id = *element.find("id");
    const auto known = ids_.find(id.value);
    if (known == ids_.end()) {
      fail_at(id.value_at, fmt::format("an alias is for an id that stands before it, and \"{}\" "
                                       "does not{}",
                                       id.value, suggestion(id.value, known_ids())));
    }
    declare(element.find("as")->value, known->second, element.find("as")->value_at);
  }

  void read_include(const XmlElement& element, const File& file, SceneNode* parent) {
    check_attributes(element, {"filename"}, {"name"});
    const XmlAttribute& filename = *element.find("filename");
    const std::filesystem::path path = find_file(filename.value, *file.folders, filename.value_at);
    std::error_code failed;
    const std::filesystem::path resolved = std::filesystem::weakly_canonical(path, failed);
    if (std::find(open_files_.begin(), open_files_.end(), resolved) != open_files_.end()) {
      fail_at(filename.value_at, fmt::format("\"{}\" includes itself", path.string()));
    }
    if (open_files_.size() >= kMaxIncludes) {
      fail_at(filename.value_at, fmt::format("includes are nested deeper than {}", kMaxIncludes));
    }
    const XmlElement root = open(path);
    const File inner = file_of(root, path, *file.folders);
    if (root.tag == "scene") {
      for (const XmlElement& child : root.children) read_child(child, inner, parent);
    } else if (is_object_tag(root.tag)) {
      const std::size_t child = add_child(element, file, parent, element.at, false);
      parent->children[child].node = read_object(root, inner, nullptr);
    } else {
      fail_at(root.at,
              fmt::format("an included file holds a <scene> or an object, not <{}>", root.tag));
    }
    open_files_.pop_back();
  }

  std::vector<std::string> known_ids() const {
    std::vector<std::string> ids;
    for (const auto& entry : ids_) ids.push_back(entry.first);
    return ids;
  }

  void resolve_references() {
    for (const PendingReference& reference : pending_) {
      const auto found = ids_.find(reference.id);
      if (found == ids_.end()) {
        fail_at(reference.id_at, fmt::format("nothing has the id \"{}\"{}", reference.id,
                                             suggestion(reference.id, known_ids())));
      }
      reference.parent->children[reference.child].node = found->second;
    }
  }

  void check_cycles(const SceneNode& node, int nesting) {
    if (visited_.contains(&node)) return;
    if (std::find(path_.begin(), path_.end(), &node) != path_.end()) {
      node.fail(fmt::format("{} refers to itself", node.label()));
    }
    if (nesting > kMaxReferences) {
      node.fail(fmt::format("references are nested deeper than {}", kMaxReferences));
    }
    path_.push_back(&node);
    for (const SceneNode::Child& child : node.children) check_cycles(*child.node, nesting + 1);
    path_.pop_back();
    visited_.insert(&node);
  }

  void check_definitions(const std::filesystem::path& path) const {
    std::vector<std::string> known;
    for (const auto& [name, parameter] : parameters_) {
      if (parameter.is_used) known.push_back(name);
    }
    for (const auto& [name, parameter] : parameters_) {
      if (parameter.is_used) continue;
      throw Error(fmt::format("-D {}={}: {} has no parameter of that name{}", name, parameter.value,
                              path.string(), suggestion(name, known)));
    }
  }

  SceneDocument document_{};
  std::map<std::string, Parameter> parameters_;
  std::map<std::string, SceneNode*> ids_;
  std::vector<PendingReference> pending_;
  std::vector<std::filesystem::path> open_files_;
  std::vector<const SceneNode*> path_;
  std::set<const SceneNode*> visited_;
};

}  // namespace

SceneDocument read_scene_document(const std::filesystem::path& path,
                                  const Definitions& definitions) {
  return DocumentReader(definitions).read(path);
}

}  // namespace brume
