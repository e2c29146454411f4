// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "io/nearest_name.h"
#include "io/number_text.h"
#include "io/scene_builder.h"

namespace brume {
namespace {

// One integrator serves every name under which scenes ask for light transport.
IntegratorSettings volumetric_path(const SceneNode& node, BuildContext& context) {
  constexpr std::int64_t kMax = 1 << 30;
  IntegratorSettings settings;
  settings.path.max_depth = int(node.integer("max_depth", -1, -1, kMax));
  settings.path.rr_depth = int(node.integer("rr_depth", 5, 1, kMax));
  settings.path.hide_emitters = node.boolean("hide_emitters", false);
  context.accept(node, {"samples_per_pass", "block_size", "timeout"});
  if (node.type == "volpathmis") context.accept(node, {"use_spectral_mis"});
  // The number of an exercise in the scenes of a teaching renderer, and checks of old versions.
  if (node.old_dialect) context.accept(node, {"version", "strict_normals"});
  return settings;
}

IntegratorSettings wrapped(const SceneNode& node, BuildContext& context) {
  const SceneNode* inner = node.only_child("integrator");
  if (inner == nullptr) node.fail(fmt::format("{} needs an integrator inside", node.label()));
  return build_integrator(*inner, context);
}

IntegratorSettings moment(const SceneNode& node, BuildContext& context) {
  context.notices.warn(
      "integrator \"moment\": the layer stderr holds the standard error of the mean instead of "
      "second moments");
  return wrapped(node, context);
}

// "name:type, name:type"
IntegratorSettings aov(const SceneNode& node, BuildContext& context) {
  const std::vector<std::string> valid = {"albedo", "depth"};
  IntegratorSettings settings = wrapped(node, context);
  node.require("aovs", "layers as name:type");
  const std::string aovs = node.text("aovs", "");
  for (const std::string_view word : split_words(aovs)) {
    const std::string type(word.substr(word.find(':') + 1));
    if (std::find(valid.begin(), valid.end(), type) == valid.end()) {
      fail_at(node.position("aovs"), fmt::format("unknown layer type \"{}\" in \"{}\"{}", type,
                                                 word, suggestion(type, valid)));
    }
    if (std::find(settings.aovs.begin(), settings.aovs.end(), type) == settings.aovs.end()) {
      settings.aovs.push_back(type);
    }
  }
  return settings;
}

constexpr Plugin<IntegratorSettings (*)(const SceneNode&, BuildContext&)> kIntegrators[] = {
    {"volpath", volumetric_path},
    {"volpathmis", volumetric_path},
    {"path", volumetric_path},
    {"moment", moment},
    {"aov", aov}};

}  // namespace

IntegratorSettings build_integrator(const SceneNode& node, BuildContext& context) {
  IntegratorSettings settings = find_plugin(node, kIntegrators)(node, context);
  node.finish();
  return settings;
}

}  // namespace brume
