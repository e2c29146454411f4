// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "io/scene_builder.h"
#include "io/scene_volume.h"
#include "medium/heterogeneous_medium.h"
#include "medium/homogeneous_medium.h"
#include "medium/similar_medium.h"

namespace brume {
namespace {

using MediumPtr = std::shared_ptr<const Medium>;

HenyeyGreenstein isotropic(const SceneNode& /*node*/) {
  return {.g = 0.0f};
}

HenyeyGreenstein henyey_greenstein(const SceneNode& node) {
  return {.g = float(node.number("g", 0.8, {.min = -1.0, .max = 1.0}))};
}

constexpr Plugin<HenyeyGreenstein (*)(const SceneNode&)> kPhases[] = {{"isotropic", isotropic},
                                                                      {"hg", henyey_greenstein}};

HenyeyGreenstein phase_of(const SceneNode& medium) {
  const SceneNode* node = medium.only_child("phase");
  if (node == nullptr) return {.g = 0.0f};
  const HenyeyGreenstein phase = find_plugin(*node, kPhases)(*node);
  node->finish();
  return phase;
}

void accept_sampling_hints(const SceneNode& node, BuildContext& context) {
  context.accept(node, {"sample_emitters", "has_spectral_extinction"});
  if (node.old_dialect) context.accept(node, {"method", "step_size"});
}

struct Coefficients {
  Rgb sigma_t;  // [1/unit]
  Rgb albedo;
};

// The older dialect's other way to give the same two numbers.
Coefficients from_absorption_and_scattering(const SceneNode& node) {
  for (const char* name : {"sigma_t", "albedo"}) {
    if (node.has(name)) {
      fail_at(node.position(name),
              fmt::format("{} mixes sigmaA and sigmaS with {}; give either sigmaA and sigmaS or "
                          "sigmaT and albedo",
                          node.label(), name));
    }
  }
  const Rgb sigma_a = node.colour("sigma_a", 0.0, ColourUse::kCoefficient);
  const Rgb sigma_s = node.colour("sigma_s", 0.0, ColourUse::kCoefficient);
  const Rgb sigma_t = sigma_a + sigma_s;
  Rgb albedo{0.0f};
  for (int i = 0; i < 3; ++i) {
    if (sigma_t[i] > 0.0f) albedo[i] = sigma_s[i] / sigma_t[i];
  }
  return {sigma_t, albedo};
}

Coefficients constant_coefficients(const SceneNode& node, BuildContext& context) {
  if (node.old_dialect && (node.has("sigma_a") || node.has("sigma_s"))) {
    return from_absorption_and_scattering(node);
  }
  const auto constant = [&](const char* name, double fallback, ColourUse use) {
    if (const SceneNode* child = node.named_child("volume", name);
        child != nullptr && child->type != "constvolume") {
      child->fail(
          fmt::format("{} has the same {} everywhere; use a medium of type "
                      "\"heterogeneous\" for a volume that varies",
                      node.label(), name));
    }
    return *volume_parameter(node, name, fallback, use, context).constant;
  };
  return {.sigma_t = constant("sigma_t", 1.0, ColourUse::kCoefficient),
          .albedo = constant("albedo", 0.75, ColourUse::kReflectance)};
}

MediumPtr build_homogeneous(const SceneNode& node, BuildContext& context) {
  const Coefficients c = constant_coefficients(node, context);
  const Rgb sigma_t = c.sigma_t * float(node.number("scale", 1.0, kNonNegative));
  if (!is_finite_and_non_negative(sigma_t)) {
    node.fail(fmt::format("sigma_t times scale of {} is beyond floating point", node.label()));
  }
  accept_sampling_hints(node, context);
  const HenyeyGreenstein phase = phase_of(node);
  auto medium = std::make_shared<HomogeneousMedium>(sigma_t, c.albedo, phase);
  if (!context.tracking.similar_media) return medium;
  const SimilarCoefficients similar = similar_coefficients(c.albedo, phase.g);
  return make_similar_medium(std::move(medium), std::make_shared<HomogeneousMedium>(
                                                    sigma_t * similar.extinction_scale,
                                                    similar.albedo, HenyeyGreenstein{.g = 0.0f}));
}

std::shared_ptr<const ColorField> albedo_field(const SceneNode& node, BuildContext& context) {
  const SceneVolume albedo =
      volume_parameter(node, "albedo", 0.75, ColourUse::kReflectance, context);
  if (albedo.constant) return std::make_shared<ConstantField>(*albedo.constant);
  constexpr float kRounding = 1e-5f;
  if (const float largest = largest_value(albedo.grid); largest > 1.0f + kRounding) {
    node.fail(fmt::format("the albedo of {} reaches {} in {}; it must lie in [0, 1]", node.label(),
                          largest, albedo.source));
  }
  return std::visit([](const auto& grid) { return make_grid_field(grid); }, albedo.grid);
}

MediumPtr build_heterogeneous(const SceneNode& node, BuildContext& context) {
  // Older scenes call it density; it is the extinction all the same.
  const bool has_density = node.old_dialect && node.named_child("volume", "density") != nullptr;
  const SceneVolume sigma_t = volume_parameter(node, has_density ? "density" : "sigma_t", 1.0,
                                               ColourUse::kCoefficient, context);
  const float scale = float(node.number("scale", 1.0, kNonNegative));
  accept_sampling_hints(node, context);
  const AnyGrid density = as_grid(sigma_t);
  context.placed.extend(world_bounds(density));
  if (!std::isfinite(largest_value(density) * scale)) {
    node.fail(fmt::format("sigma_t times scale of {} is beyond floating point", node.label()));
  }
  const auto albedo = albedo_field(node, context);
  const HenyeyGreenstein phase = phase_of(node);
  return std::visit(
      [&](const auto& grid) {
        return make_heterogeneous_medium(grid, scale, albedo, phase, context.tracking);
      },
      density);
}

constexpr Plugin<MediumPtr (*)(const SceneNode&, BuildContext&)> kMedia[] = {
    {"homogeneous", build_homogeneous}, {"heterogeneous", build_heterogeneous}};

}  // namespace

std::shared_ptr<const Medium> build_medium(const SceneNode& node, BuildContext& context) {
  MediumPtr& medium = context.media[&node];
  if (medium == nullptr) {
    medium = find_plugin(node, kMedia)(node, context);
    node.finish();
  }
  return medium;
}

}  // namespace brume
