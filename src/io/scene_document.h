// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "io/scene_file.h"
#include "io/scene_node.h"

namespace brume {

/// A scene file and those that it includes as a graph of objects: parameters substituted,
/// references resolved, names of the older dialect renamed.
struct SceneDocument {
  std::vector<std::unique_ptr<SceneNode>> nodes;
  const SceneNode* root;                     // the <scene>
  std::vector<std::filesystem::path> files;  // that were read for it, itself first
};

/// Throws an Error with position for what is not a well-formed scene file; what its objects mean
/// is not looked at.
SceneDocument read_scene_document(const std::filesystem::path& path,
                                  const Definitions& definitions);

}  // namespace brume
