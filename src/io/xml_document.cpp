// SPDX-License-Identifier: Apache-2.0
#include "io/xml_document.h"

#include <fmt/format.h>

#include <pugixml.hpp>

#include "core/error.h"

namespace brume {
namespace {

constexpr int kMaxNesting = 64;

// pugixml parses in place, so every string that it hands out starts where it stood in the file.
class Converter {
 public:
  Converter(std::shared_ptr<const SourceFile> file, const char* buffer)
      : file_(std::move(file)), buffer_(buffer) {}

  SourcePosition position(std::ptrdiff_t offset) const {
    return {.file = file_, .offset = std::size_t(std::max<std::ptrdiff_t>(offset, 0))};
  }
  SourcePosition position(const char* text) const { return position(text - buffer_); }

  XmlElement element(const pugi::xml_node& node, int nesting) const {
    XmlElement result{.tag = node.name(), .at = position(node.name())};
    if (nesting > kMaxNesting) {
      fail_at(result.at, fmt::format("elements are nested deeper than {}", kMaxNesting));
    }
    for (const pugi::xml_attribute& a : node.attributes()) {
      if (const XmlAttribute* first = result.find(a.name())) {
        fail_at(position(a.name()), fmt::format("attribute \"{}\" is given twice", first->name));
      }
      // An empty value is not in the buffer; it stands after `name="`.
      const std::string name = a.name();
      const SourcePosition at = position(a.name());
      const SourcePosition value_at = *a.value() != '\0'
                                          ? position(a.value())
                                          : position(std::ptrdiff_t(at.offset + name.size() + 2));
      result.attributes.push_back({name, a.value(), at, value_at});
    }
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element) {
        result.children.push_back(element(child, nesting + 1));
      } else {
        fail_at(position(child.value()), fmt::format("text does not belong in <{}>", result.tag));
      }
    }
    return result;
  }

 private:
  std::shared_ptr<const SourceFile> file_;
  const char* buffer_;
};

}  // namespace

const XmlAttribute* XmlElement::find(std::string_view name) const {
  for (const XmlAttribute& a : attributes) {
    if (a.name == name) return &a;
  }
  return nullptr;
}

XmlElement read_xml(const std::filesystem::path& path) {
  const auto file = std::make_shared<const SourceFile>(SourceFile{path, read_whole_file(path)});
  if (const std::size_t nul = file->text.find('\0'); nul != std::string::npos) {
    fail_at({file, 0}, fmt::format("is not UTF-8 text: byte {} is zero", nul));
  }
  std::string buffer = file->text;
  buffer.reserve(buffer.size() + 1);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer_inplace(
      buffer.data(), buffer.size(), pugi::parse_default, pugi::encoding_utf8);
  const Converter converter(file, buffer.data());
  if (!parsed) {
    fail_at(converter.position(parsed.offset),
            fmt::format("not well-formed XML: {}", parsed.description()));
  }
  const pugi::xml_node root = document.document_element();
  for (const pugi::xml_node& other : document.children()) {
    if (other.type() == pugi::node_element && other != root) {
      fail_at(converter.position(other.name()),
              fmt::format("a second root element <{}> after <{}>", other.name(), root.name()));
    }
  }
  return converter.element(root, 0);
}

}  // namespace brume
