// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the scene reader of this folder: from the objects of a scene file to those of brume.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "io/scene_file.h"
#include "io/scene_node.h"
#include "material/bsdf.h"
#include "material/texture.h"
#include "medium/medium.h"

namespace brume {

/// What has been built so far: an object that is referred to twice is built once.
struct BuildContext {
  Notices& notices;
  TrackingSettings tracking{};
  glm::dvec3 origin{0.0};  // where rendering has its origin, as the file counts [unit]
  Box3 placed{};           // around shapes and volumes, counted from `origin` [unit]
  std::map<const SceneNode*, std::shared_ptr<const Bsdf>> bsdfs{};
  std::map<const SceneNode*, std::shared_ptr<const Texture>> textures{};
  std::map<const SceneNode*, std::shared_ptr<const Medium>> media{};
  std::vector<std::string> without_effect{};  // parameters that brume accepts and does not need

  /// The parameter of this name of something that has a place, counted from `origin`.
  glm::dmat4 to_world(const SceneNode& node) const;
  /// Accepts parameters of Mitsuba that change nothing here, and notes those that are given.
  void accept(const SceneNode& node, std::initializer_list<std::string_view> names);
};

/// A kind of object, such as the bsdf "diffuse", with the function that builds it.
template <class Build>
struct Plugin {
  std::string_view type;
  Build build;
};

/// Throws at the type of `node`: it is none of `supported`.
[[noreturn]] void fail_unsupported(const SceneNode& node,
                                   const std::vector<std::string>& supported);

/// The function for the type of `node`. Throws with the nearest supported type.
template <class Table>
auto find_plugin(const SceneNode& node, const Table& table) {
  for (const auto& plugin : table) {
    if (plugin.type == node.type) return plugin.build;
  }
  std::vector<std::string> supported;
  for (const auto& plugin : table) supported.emplace_back(plugin.type);
  fail_unsupported(node, supported);
}

std::shared_ptr<const Texture> build_texture(const SceneNode& node, BuildContext& context);
/// The parameter `name` of a material: a texture, or a colour in [0, 1].
std::shared_ptr<const Texture> texture_parameter(const SceneNode& node, std::string_view name,
                                                 double fallback, BuildContext& context);
std::shared_ptr<const Bsdf> build_bsdf(const SceneNode& node, BuildContext& context);
std::shared_ptr<const Medium> build_medium(const SceneNode& node, BuildContext& context);
Surface build_surface(const SceneNode& node, BuildContext& context);
/// An emitter directly in the scene.
void build_emitter(const SceneNode& node, BuildContext& context, SceneParts& parts);

struct IntegratorSettings {
  PathSettings path;
  std::vector<std::string> aovs;  // extra layers asked for: "albedo", "depth"
};
IntegratorSettings build_integrator(const SceneNode& node, BuildContext& context);

struct SensorSettings {
  std::shared_ptr<const Camera> camera;
  FilmSettings film;
  int sample_count = 16;              // samples a pixel
  const SceneNode* medium = nullptr;  // that the file says the camera is in
  SourcePosition medium_at;
};
/// `size` replaces that of the film.
SensorSettings build_sensor(const SceneNode& node, BuildContext& context,
                            const std::optional<glm::ivec2>& size);

}  // namespace brume
