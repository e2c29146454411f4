// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string_view>

#include "io/scene_node.h"
#include "io/xml_document.h"

namespace brume {

/// Throws unless `element` has each of the attributes `required` and no other than those and
/// `optional`.
void check_attributes(const XmlElement& element, std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional = {});

/// Whether elements of this tag are parameters (<float>, <rgb>, <transform> ...).
bool is_parameter_tag(std::string_view tag);

/// The value of a parameter element. Throws with the position of what is malformed.
SceneParameter::Value parse_value(const XmlElement& element);

}  // namespace brume
