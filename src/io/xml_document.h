// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/source_file.h"

namespace brume {

struct XmlAttribute {
  std::string name, value;
  SourcePosition at;        // of the name
  SourcePosition value_at;  // of the first character between the quotes
};

/// An element with where it was written, free of the parser behind it.
struct XmlElement {
  std::string tag;
  std::vector<XmlAttribute> attributes{};
  std::vector<XmlElement> children{};
  SourcePosition at{};  // of the tag's name

  /// The attribute of that name, or nullptr.
  const XmlAttribute* find(std::string_view name) const;
};

/// Reads an XML file; its root element. Throws an Error with position for anything that is not
/// well-formed UTF-8 XML of one root element.
XmlElement read_xml(const std::filesystem::path& path);

}  // namespace brume
