// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <numbers>

#include "core/error.h"
#include "film/read_image.h"
#include "geometry/similarity.h"
#include "io/scene_builder.h"
#include "light/constant_environment.h"
#include "light/directional_light.h"
#include "light/environment_map.h"
#include "light/point_light.h"
#include "light/spot_light.h"

namespace brume {
namespace {

void check_only_one(const SceneNode& node, const char* name, const char* other) {
  if (node.has(name) && node.has(other)) {
    fail_at(node.position(name),
            fmt::format("{} has both {} and {}; give one of them", node.label(), name, other));
  }
}

void build_point(const SceneNode& node, BuildContext& context, SceneParts& parts) {
  check_only_one(node, "position", "to_world");
  const glm::dvec3 position =
      node.vec3("position", glm::dvec3(node.transform("to_world")[3])) - context.origin;
  parts.lights.push_back(std::make_shared<PointLight>(
      Vec3(position), node.colour("intensity", 1.0, ColourUse::kEmission)));
}

void build_spot(const SceneNode& node, BuildContext& context, SceneParts& parts) {
  const double cutoff_deg =
      node.number("cutoff_angle", 20.0, {.min = 0.0, .max = 180.0, .excludes_min = true});
  const double beam_deg =
      node.number("beam_width", cutoff_deg * 3.0 / 4.0, {.min = 0.0, .max = cutoff_deg});
  const auto radians = [](double degrees) { return float(degrees * std::numbers::pi / 180.0); };
  parts.lights.push_back(std::make_shared<SpotLight>(
      context.to_world(node), node.colour("intensity", 1.0, ColourUse::kEmission),
      radians(cutoff_deg), radians(beam_deg)));
}

void build_directional(const SceneNode& node, BuildContext& /*context*/, SceneParts& parts) {
  check_only_one(node, "direction", "to_world");
  const glm::dmat4 to_world = node.transform("to_world");
  const glm::dvec3 direction = node.vec3("direction", glm::dvec3(to_world[2]));
  if (direction == glm::dvec3(0.0)) {
    fail_at(node.position("direction"), "the direction of light is zero");
  }
  parts.lights.push_back(std::make_shared<DirectionalLight>(
      Vec3(glm::normalize(direction)), node.colour("irradiance", 1.0, ColourUse::kEmission)));
}

void build_constant(const SceneNode& node, BuildContext& /*context*/, SceneParts& parts) {
  parts.environments.push_back(
      std::make_shared<ConstantEnvironment>(node.colour("radiance", 1.0, ColourUse::kEmission)));
}

void build_envmap(const SceneNode& node, BuildContext& context, SceneParts& parts) {
  const std::filesystem::path path = node.file("filename");
  const float scale = float(node.number("scale", 1.0, kNonNegative));
  const glm::dmat4 to_world = node.transform("to_world");
  if (!as_similarity(to_world)) {
    fail_at(node.position("to_world"),
            fmt::format("to_world of {} must turn without shearing", node.label()));
  }
  context.accept(node, {"mis_compensation"});

  const Image image = read_image(path.string());
  if (image.height < 2) {
    throw Error(fmt::format("{}: an environment map needs two rows of pixels, this has {}",
                            path.string(), image.height));
  }
  const std::size_t r = *image.channel("R"), g = *image.channel("G"), b = *image.channel("B");
  std::vector<Rgb> pixels;
  pixels.reserve(std::size_t(image.width) * std::size_t(image.height));
  std::size_t clamped = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb c(image.at(x, y, r), image.at(x, y, g), image.at(x, y, b));
      pixels.push_back(glm::max(c, Rgb(0.0f)));
      if (pixels.back() != c) ++clamped;
    }
  }
  if (clamped > 0) {
    context.notices.warn(fmt::format("{}: {} pixels with negative radiance are black there",
                                     path.string(), clamped));
  }
  parts.environments.push_back(std::make_shared<EnvironmentMap>(
      std::move(pixels), std::size_t(image.width), std::size_t(image.height), to_world, scale));
}

void fail_area(const SceneNode& node, BuildContext& /*context*/, SceneParts& /*parts*/) {
  node.fail("an area emitter belongs in the shape that emits");
}

constexpr Plugin<void (*)(const SceneNode&, BuildContext&, SceneParts&)> kEmitters[] = {
    {"area", fail_area},          {"point", build_point},
    {"spot", build_spot},         {"directional", build_directional},
    {"constant", build_constant}, {"envmap", build_envmap}};

}  // namespace

void build_emitter(const SceneNode& node, BuildContext& context, SceneParts& parts) {
  find_plugin(node, kEmitters)(node, context, parts);
  node.finish();
}

}  // namespace brume
