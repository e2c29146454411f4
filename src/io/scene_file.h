// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/notices.h"
#include "film/filter.h"
#include "integrator/path_settings.h"
#include "io/estimator_settings.h"
#include "scene/scene.h"

namespace brume {

/// Values for the parameters of a scene ($name), by name.
using Definitions = std::map<std::string, std::string>;

/// The picture that a scene asks for.
struct FilmSettings {
  glm::ivec2 size{768, 576};       // [pixel] width and height of the whole picture
  glm::ivec2 crop_offset{0, 0};    // [pixel] first column and row that is rendered
  glm::ivec2 crop_size{768, 576};  // [pixel] of the part that is rendered
  std::shared_ptr<const Filter> filter;
};

/// A scene file ready to render.
struct LoadedScene {
  std::unique_ptr<const Scene> scene;
  std::shared_ptr<const Camera> camera;
  FilmSettings film;
  PathSettings path;
  std::vector<std::string> aovs;  // layers that an aov integrator asks for: "albedo", "depth"
  int sample_count;               // samples a pixel
  std::vector<std::filesystem::path> files;  // that were read, the input first
};

/// Reads a scene in the Mitsuba 3 XML dialect (docs/scene-format.md) with all files it refers to.
/// `size` [pixel] replaces the film's, and its crop. Throws an Error that begins with
/// `path:line:column:` for anything wrong; what was taken another way than written, or has no
/// effect, becomes a notice. `settings` change how the picture is computed.
LoadedScene load_scene(const std::filesystem::path& path, const Definitions& definitions,
                       Notices& notices, const std::optional<glm::ivec2>& size = std::nullopt,
                       const EstimatorSettings& settings = {});

}  // namespace brume
