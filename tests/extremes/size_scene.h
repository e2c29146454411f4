// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>

namespace brume::test {

/// A scene with every kind of light and medium, `size` times a scene a few units wide. Extinctions
/// and intensities change with it so that the picture does not.
std::string size_scene(double size, const glm::dvec3& center);

}  // namespace brume::test
