// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "io/nearest_name.h"
#include "io/scene_builder.h"
#include "material/conductor_bsdf.h"
#include "material/dielectric_bsdf.h"
#include "material/diffuse_bsdf.h"
#include "material/named_ior.h"
#include "material/null_bsdf.h"
#include "material/plastic_bsdf.h"
#include "material/rough_conductor_bsdf.h"
#include "material/rough_dielectric_bsdf.h"
#include "material/rough_plastic_bsdf.h"
#include "material/thin_dielectric_bsdf.h"
#include "material/two_sided_bsdf.h"

namespace brume {
namespace {

using BsdfPtr = std::shared_ptr<const Bsdf>;

template <class Names>
std::vector<std::string> as_strings(const Names& names) {
  return {names.begin(), names.end()};
}

// Index of refraction, as a number or by the name of a substance.
float ior(const SceneNode& node, std::string_view name, const std::string& fallback) {
  if (node.has(name) && !node.is_text(name)) return float(node.number(name, 1.0, kPositive));
  const std::string substance = node.text(name, fallback);
  if (const auto value = dielectric_ior(substance)) return *value;
  fail_at(node.position(name),
          fmt::format("no index of refraction is known for \"{}\"{}", substance,
                      suggestion(substance, as_strings(dielectric_names()))));
}

float relative_ior(const SceneNode& node, const std::string& inside) {
  return ior(node, "int_ior", inside) / ior(node, "ext_ior", "air");
}

ConductorIor conductor(const SceneNode& node) {
  if (!node.has("eta") && !node.has("k")) {
    const std::string material = node.text("material", "none");
    if (const auto value = conductor_ior(material)) return *value;
    fail_at(node.position("material"),
            fmt::format("no index of refraction is known for the conductor \"{}\"{}", material,
                        suggestion(material, as_strings(conductor_names()))));
  }
  if (node.has("material")) {
    fail_at(node.position("material"),
            fmt::format("{} has both a material and eta or k; give one of them", node.label()));
  }
  node.require("eta", "real part of the index of refraction");
  node.require("k", "imaginary part of the index of refraction");
  return {.eta = node.colour("eta", 0.0, ColourUse::kCoefficient),
          .k = node.colour("k", 1.0, ColourUse::kCoefficient)};
}

MicrofacetType microfacet_type(const SceneNode& node) {
  return node.choice("distribution", {"beckmann", "ggx"}) == "ggx" ? MicrofacetType::kGgx
                                                                   : MicrofacetType::kBeckmann;
}

Microfacets microfacets(const SceneNode& node, BuildContext& context) {
  constexpr NumberRange kRoughness{.min = 0.0, .max = 10.0};
  constexpr double kDefault = 0.1;
  context.accept(node, {"sample_visible"});
  const bool has_axes = node.has("alpha_u") || node.has("alpha_v");
  if (has_axes && node.has("alpha")) {
    fail_at(node.position("alpha"), fmt::format("{} has both alpha and alpha_u or alpha_v; give "
                                                "one or the others",
                                                node.label()));
  }
  const double alpha = node.number("alpha", kDefault, kRoughness);
  if (!has_axes) return {microfacet_type(node), float(alpha), float(alpha)};
  node.require("alpha_u", "roughness along u");
  node.require("alpha_v", "roughness along v");
  return {microfacet_type(node), float(node.number("alpha_u", kDefault, kRoughness)),
          float(node.number("alpha_v", kDefault, kRoughness))};
}

BsdfPtr build_diffuse(const SceneNode& node, BuildContext& context) {
  const bool has_old_name = node.old_dialect && node.has("diffuse_reflectance");
  return std::make_shared<DiffuseBsdf>(
      texture_parameter(node, has_old_name ? "diffuse_reflectance" : "reflectance", 0.5, context));
}

BsdfPtr build_dielectric(const SceneNode& node, BuildContext& context) {
  return std::make_shared<DielectricBsdf>(
      relative_ior(node, "bk7"), texture_parameter(node, "specular_reflectance", 1.0, context),
      texture_parameter(node, "specular_transmittance", 1.0, context));
}

BsdfPtr build_thin_dielectric(const SceneNode& node, BuildContext& context) {
  return std::make_shared<ThinDielectricBsdf>(
      relative_ior(node, "bk7"), texture_parameter(node, "specular_reflectance", 1.0, context),
      texture_parameter(node, "specular_transmittance", 1.0, context));
}

BsdfPtr build_rough_dielectric(const SceneNode& node, BuildContext& context) {
  const float eta = relative_ior(node, "bk7");
  if (eta == 1.0f) {
    node.fail(
        fmt::format("{} has the same index of refraction on both sides, which roughness "
                    "cannot show; use the bsdf \"null\"",
                    node.label()));
  }
  return std::make_shared<RoughDielectricBsdf>(
      microfacets(node, context), eta,
      texture_parameter(node, "specular_reflectance", 1.0, context),
      texture_parameter(node, "specular_transmittance", 1.0, context));
}

BsdfPtr build_conductor(const SceneNode& node, BuildContext& context) {
  const ConductorIor metal = conductor(node);
  return std::make_shared<ConductorBsdf>(
      metal.eta, metal.k, texture_parameter(node, "specular_reflectance", 1.0, context));
}

BsdfPtr build_rough_conductor(const SceneNode& node, BuildContext& context) {
  const ConductorIor metal = conductor(node);
  return std::make_shared<RoughConductorBsdf>(
      microfacets(node, context), metal.eta, metal.k,
      texture_parameter(node, "specular_reflectance", 1.0, context));
}

BsdfPtr build_plastic(const SceneNode& node, BuildContext& context) {
  return std::make_shared<PlasticBsdf>(
      relative_ior(node, "polypropylene"),
      texture_parameter(node, "diffuse_reflectance", 0.5, context),
      texture_parameter(node, "specular_reflectance", 1.0, context),
      node.boolean("nonlinear", false));
}

BsdfPtr build_rough_plastic(const SceneNode& node, BuildContext& context) {
  context.accept(node, {"sample_visible"});
  const float alpha = float(node.number("alpha", 0.1, {.min = 0.0, .max = 10.0}));
  return std::make_shared<RoughPlasticBsdf>(
      Microfacets(microfacet_type(node), alpha, alpha), relative_ior(node, "polypropylene"),
      texture_parameter(node, "diffuse_reflectance", 0.5, context),
      texture_parameter(node, "specular_reflectance", 1.0, context),
      node.boolean("nonlinear", false));
}

BsdfPtr build_null(const SceneNode& /*node*/, BuildContext& /*context*/) {
  return std::make_shared<NullBsdf>();
}

BsdfPtr build_two_sided(const SceneNode& node, BuildContext& context) {
  const std::vector<SceneNode::Child> sides = node.children_of("bsdf");
  if (sides.empty() || sides.size() > 2) {
    node.fail(fmt::format("{} needs one bsdf inside, or two for front and back; it has {}",
                          node.label(), sides.size()));
  }
  for (const SceneNode::Child& side : sides) {
    for (const char* type :
         {"dielectric", "thindielectric", "roughdielectric", "null", "twosided"}) {
      if (side.node->type == type) {
        fail_at(side.at,
                fmt::format("a twosided bsdf takes one-sided materials, not \"{}\"", type));
      }
    }
  }
  const BsdfPtr front = build_bsdf(*sides.front().node, context);
  return std::make_shared<TwoSidedBsdf>(front, build_bsdf(*sides.back().node, context));
}

using Build = BsdfPtr (*)(const SceneNode&, BuildContext&);
constexpr Plugin<Build> kBsdfs[] = {{"diffuse", build_diffuse},
                                    {"dielectric", build_dielectric},
                                    {"thindielectric", build_thin_dielectric},
                                    {"roughdielectric", build_rough_dielectric},
                                    {"conductor", build_conductor},
                                    {"roughconductor", build_rough_conductor},
                                    {"plastic", build_plastic},
                                    {"roughplastic", build_rough_plastic},
                                    {"null", build_null},
                                    {"twosided", build_two_sided}};

}  // namespace

std::shared_ptr<const Bsdf> build_bsdf(const SceneNode& node, BuildContext& context) {
  BsdfPtr& bsdf = context.bsdfs[&node];
  if (bsdf == nullptr) {
    const BsdfPtr built = find_plugin(node, kBsdfs)(node, context);
    node.finish();
    bsdf = built;
  }
  return bsdf;
}

}  // namespace brume
