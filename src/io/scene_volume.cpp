// SPDX-License-Identifier: Apache-2.0
#include "io/scene_volume.h"

#include <fmt/format.h>

#include "core/error.h"
#include "io/constant_grid.h"
#include "volume/bounds_grid.h"

namespace brume {
namespace {

Interpolation interpolation(const SceneNode& node) {
  return node.choice("filter_type", {"trilinear", "nearest"}) == "nearest"
             ? Interpolation::kNearest
             : Interpolation::kTrilinear;
}

SceneVolume load(const SceneNode& node, const VolumeRequest& request, BuildContext& context) {
  try {
    return {.constant = {},
            .to_world = request.to_world,
            .grid = load_grid(request, context.notices),
            .source = request.path};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    fail_at(node.position(request.grid.empty() ? "filename" : "grid"), error.what());
  }
}

SceneVolume constant_volume(const SceneNode& node, ColourUse use, BuildContext& context) {
  return {.constant = node.colour("value", 1.0, use),
          .to_world = context.to_world(node),
          .source = node.label()};
}

void check_extension(const SceneNode& node, const std::filesystem::path& path,
                     std::initializer_list<std::string_view> extensions, const char* other) {
  for (const std::string_view extension : extensions) {
    if (path.extension() == extension) return;
  }
  fail_at(node.position("filename"),
          fmt::format("{} does not read \"{}\" files; did you mean the volume type \"{}\"?",
                      node.label(), path.extension().string(), other));
}

SceneVolume grid_volume(const SceneNode& node, ColourUse /*use*/, BuildContext& context) {
  const std::filesystem::path path = node.file("filename");
  check_extension(node, path, {".vol"}, "vdb");
  const std::string wrap = node.choice("wrap_mode", {"clamp", "repeat", "mirror"});
  context.accept(node, {"raw", "accel", "max_value"});
  // Before version 2 the box in the file always placed the data.
  const VolumeRequest request{.path = path.string(),
                              .interpolation = interpolation(node),
                              .wrap = wrap == "repeat"   ? Wrap::kRepeat
                                      : wrap == "mirror" ? Wrap::kMirror
                                                         : Wrap::kClamp,
                              .use_grid_bbox = node.boolean("use_grid_bbox", node.old_dialect),
                              .to_world = context.to_world(node)};
  return load(node, request, context);
}

SceneVolume vdb_volume(const SceneNode& node, ColourUse /*use*/, BuildContext& context) {
  const std::filesystem::path path = node.file("filename");
  check_extension(node, path, {".vdb", ".nvdb"}, "gridvolume");
  const VolumeRequest request{.path = path.string(),
                              .grid = node.text("grid", ""),
                              .interpolation = interpolation(node),
                              .to_world = context.to_world(node)};
  return load(node, request, context);
}

using Build = SceneVolume (*)(const SceneNode&, ColourUse, BuildContext&);
constexpr Plugin<Build> kVolumes[] = {
    {"constvolume", constant_volume}, {"gridvolume", grid_volume}, {"vdb", vdb_volume}};

}  // namespace

SceneVolume volume_parameter(const SceneNode& medium, std::string_view name, double fallback,
                             ColourUse use, BuildContext& context) {
  const SceneNode* node = medium.named_child("volume", name);
  if (node == nullptr) {
    return {.constant = medium.colour(name, fallback, use), .source = medium.label()};
  }
  SceneVolume volume = find_plugin(*node, kVolumes)(*node, use, context);
  node->finish();
  return volume;
}

AnyGrid as_grid(const SceneVolume& volume) {
  return volume.constant ? make_constant_grid(*volume.constant, volume.to_world) : volume.grid;
}

Box3 world_bounds(const AnyGrid& grid) {
  return std::visit(
      [](const auto& g) {
        const glm::dvec3 corners[2] = {glm::dvec3(g->box().min), glm::dvec3(g->box().max)};
        Box3 bounds;
        for (int i = 0; i < 8; ++i) {
          const glm::dvec4 corner(corners[i & 1].x, corners[i >> 1 & 1].y, corners[i >> 2].z, 1.0);
          bounds.extend(Vec3(glm::dvec3(g->world_from_index() * corner)));
        }
        return bounds;
      },
      grid);
}

float largest_value(const AnyGrid& grid) {
  return std::visit([](const auto& g) { return BoundsGrid(*g).total().max; }, grid);
}

}  // namespace brume
