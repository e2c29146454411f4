// SPDX-License-Identifier: Apache-2.0
#include "io/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "io/nearest_name.h"
#include "io/scene_builder.h"
#include "io/scene_document.h"
#include "io/transform.h"
#include "scene/contradiction.h"

namespace brume {
namespace {

// Objects that something refers to, or that stand inside another object.
std::set<const SceneNode*> used_nodes(const SceneDocument& document) {
  std::set<const SceneNode*> used;
  for (const auto& node : document.nodes) {
    for (const SceneNode::Child& child : node->children) {
      if (node.get() != document.root || child.is_reference) used.insert(child.node);
    }
  }
  return used;
}

// Media that the boundaries of shapes name.
std::set<const SceneNode*> media_of_shapes(const SceneDocument& document) {
  std::set<const SceneNode*> media;
  for (const auto& node : document.nodes) {
    if (node->tag != "shape") continue;
    for (const SceneNode::Child& child : node->children) media.insert(child.node);
  }
  return media;
}

// The medium that fills the space outside all shapes: the one that the scene refers to, or else
// the one that stands directly in the scene and belongs to no shape.
const SceneNode* world_medium_of(const SceneDocument& document, Notices& notices) {
  const std::set<const SceneNode*> taken = media_of_shapes(document);
  const std::vector<SceneNode::Child> media = document.root->children_of("medium");
  std::vector<SceneNode::Child> candidates;
  std::copy_if(media.begin(), media.end(), std::back_inserter(candidates),
               [](const SceneNode::Child& c) { return c.is_reference; });
  if (candidates.empty()) {
    std::copy_if(media.begin(), media.end(), std::back_inserter(candidates),
                 [&](const SceneNode::Child& c) { return !taken.contains(c.node); });
  }
  if (candidates.empty()) return nullptr;
  if (candidates.size() > 1) {
    fail_at(candidates[1].at,
            fmt::format("{} and {} would both fill the space outside all shapes; name one with "
                        "<ref id=\"...\"/> in the scene, or remove the other",
                        candidates[0].node->label(), candidates[1].node->label()));
  }
  const SceneNode::Child& world = candidates.front();
  if (!world.is_reference && !world.node->id.empty()) {
    notices.note(fmt::format("{} belongs to no shape: it fills the space outside all shapes",
                             world.node->label()));
  }
  return world.node;
}

const SceneNode& sensor_of(const SceneNode& root, Notices& notices) {
  const std::vector<SceneNode::Child> sensors = root.children_of("sensor");
  if (sensors.empty()) root.fail("the scene has no sensor");
  if (sensors.size() > 1) {
    notices.warn(fmt::format("the scene has {} sensors; the first is used", sensors.size()));
  }
  return *sensors.front().node;
}

void warn_of_darkness(const SceneParts& parts, Notices& notices) {
  const bool shines = !parts.lights.empty() || !parts.environments.empty() ||
                      std::any_of(parts.surfaces.begin(), parts.surfaces.end(),
                                  [](const Surface& s) { return s.radiance.has_value(); });
  if (!shines) notices.warn("the scene has no emitter: its picture is black");
}

// Anything else that is referred to stands in the scene already.
void check_references(const SceneNode& root) {
  for (const SceneNode::Child& child : root.children) {
    if (child.is_reference && child.node->tag != "medium") {
      fail_at(child.at, fmt::format("a reference directly in the scene names the medium outside "
                                    "all shapes, not a {}",
                                    child.node->tag));
    }
  }
}

void note_unused(const SceneDocument& document, Notices& notices) {
  const std::set<const SceneNode*> used = used_nodes(document);
  for (const char* tag : {"bsdf", "texture", "phase", "volume", "sampler", "film", "rfilter"}) {
    for (const SceneNode::Child& child : document.root->children_of(tag)) {
      if (!used.contains(child.node)) {
        notices.warn(
            fmt::format("{}: {} is used nowhere", child.at.to_string(), child.node->label()));
      }
    }
  }
}

std::string name_of(const Medium* medium, const BuildContext& context) {
  for (const auto& [node, known] : context.media)
    if (known.get() == medium) return node->label();
  return medium == nullptr ? "vacuum" : "another medium";
}

/// `shapes` belong to the scene's nodes, in their order.
void warn_of_contradiction(const SceneNode& root, const std::vector<const Shape*>& shapes,
                           const Scene& scene, const BuildContext& context) {
  const auto found = find_contradiction(scene);
  if (!found) return;
  const auto node_of = [&](std::uint32_t surface) {
    const auto at = std::find(shapes.begin(), shapes.end(), scene.surfaces()[surface].shape.get());
    return root.children_of("shape")[std::size_t(at - shapes.begin())].node;
  };
  const SceneNode *from = node_of(found->from), *to = node_of(found->to);
  context.notices.warn(fmt::format(
      "{}: this {} and the {} at {} contradict each other: between them there is {} by the first "
      "and {} by the second. Light goes by the last boundary that it crossed. Give a body that "
      "stands in another the other's medium as its exterior, and let bodies of fog not overlap",
      from->at.to_string(), from->label(), to->label(), to->at.to_string(),
      name_of(found->left, context), name_of(found->met, context)));
}

// The medium at the camera is found from the scene. Where the file says one, both must agree.
void check_camera_medium(const SceneNode& sensor_node, const SensorSettings& sensor,
                         const Scene& scene, BuildContext& context) {
  if (sensor.medium == nullptr) return;
  const Vec3 position = sensor.camera->ray(Vec2(0.5f), Vec2(0.5f)).ray.o;
  const Scene::MediumAt found = scene.medium_at(position);
  if (found.medium == build_medium(*sensor.medium, context).get()) return;
  const std::string message =
      fmt::format("{} refers to {}, but the boundaries around it put it in {}", sensor_node.label(),
                  sensor.medium->label(), name_of(found.medium, context));
  if (found.unanimous) fail_at(sensor.medium_at, message);
  context.notices.warn(
      fmt::format("{}: {} (not all of them agree)", sensor.medium_at.to_string(), message));
}

/// Where floats count from when what is placed lies so far from the origin of the file that they
/// lose more than four bits there; nothing when that origin will do.
std::optional<glm::dvec3> nearer_origin(const Box3& placed) {
  if (placed.empty()) return std::nullopt;
  const Vec3 center = placed.center(), away = glm::abs(center), size = placed.size();
  constexpr float kFar = 16.0f;  // in sizes
  if (std::max({away.x, away.y, away.z}) <= kFar * std::max({size.x, size.y, size.z}))
    return std::nullopt;
  return glm::dvec3(center);
}

struct World {
  SceneParts parts;
  SensorSettings sensor;
};

World build_world(const SceneDocument& document, const SceneNode& sensor, BuildContext& context,
                  const std::optional<glm::ivec2>& size) {
  const SceneNode& root = *document.root;
  World world;
  // Settings first: they are checked at once, while media and meshes may take a while to load.
  world.sensor = build_sensor(sensor, context, size);
  for (const SceneNode::Child& child : root.children_of("emitter")) {
    build_emitter(*child.node, context, world.parts);
  }
  for (const SceneNode::Child& child : root.children_of("shape")) {
    world.parts.surfaces.push_back(build_surface(*child.node, context));
  }
  if (const SceneNode* medium = world_medium_of(document, context.notices)) {
    world.parts.world_medium = build_medium(*medium, context);
  }
  return world;
}

// Each file once, the scene's own first.
std::vector<std::filesystem::path> files_of(const SceneDocument& document) {
  std::vector<std::filesystem::path> files = document.files;
  for (const auto& node : document.nodes) {
    for (const std::filesystem::path& file : node->files()) {
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
  }
  return files;
}

}  // namespace

glm::dmat4 BuildContext::to_world(const SceneNode& node) const {
  return translation(-origin) * node.transform("to_world");
}

void BuildContext::accept(const SceneNode& node, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (const SceneParameter* p = node.find(name)) {
      without_effect.push_back(fmt::format("{} of {}", p->written, node.label()));
    }
  }
}

void fail_unsupported(const SceneNode& node, const std::vector<std::string>& supported) {
  const std::string nearest = nearest_name(node.type, supported);
  fail_at(node.type_at,
          fmt::format("the {} type \"{}\" is not supported{} Supported: {}", node.tag, node.type,
                      nearest.empty() ? "." : fmt::format("; did you mean \"{}\"?", nearest),
                      fmt::join(supported, ", ")));
}

LoadedScene load_scene(const std::filesystem::path& path, const Definitions& definitions,
                       Notices& notices, const std::optional<glm::ivec2>& size,
                       const EstimatorSettings& settings) {
  const SceneDocument document = read_scene_document(path, definitions);
  const SceneNode& root = *document.root;
  BuildContext context{.notices = notices, .tracking = media_settings(settings)};
  check_references(root);

  IntegratorSettings integrator;
  if (const SceneNode* node = root.only_child("integrator")) {
    integrator = build_integrator(*node, context);
  }
  integrator.path.lighting = settings.lighting;
  integrator.path.approximations = settings.approximations;
  const SceneNode& sensor_node = sensor_of(root, notices);
  World world = build_world(document, sensor_node, context, size);
  if (const auto origin = nearer_origin(context.placed)) {
    // All again, from the file's doubles, as floats have lost digits already.
    world = {};
    context.media.clear();
    Notices given_already;
    BuildContext moved{.notices = given_already, .tracking = context.tracking, .origin = *origin};
    world = build_world(document, sensor_node, moved, size);
    context.media = std::move(moved.media);
  }
  warn_of_darkness(world.parts, notices);
  note_unused(document, notices);
  root.finish();

  std::vector<const Shape*> shapes;
  for (const Surface& surface : world.parts.surfaces) shapes.push_back(surface.shape.get());
  auto scene = std::make_unique<const Scene>(std::move(world.parts));
  warn_of_contradiction(root, shapes, *scene, context);
  check_camera_medium(sensor_node, world.sensor, *scene, context);
  if (!context.without_effect.empty()) {
    notices.warn(
        fmt::format("accepted without effect: {}", fmt::join(context.without_effect, ", ")));
  }
  return {.scene = std::move(scene),
          .camera = world.sensor.camera,
          .film = world.sensor.film,
          .path = integrator.path,
          .aovs = std::move(integrator.aovs),
          .sample_count = world.sensor.sample_count,
          .files = files_of(document)};
}

}  // namespace brume
