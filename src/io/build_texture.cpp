// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/error.h"
#include "film/read_image.h"
#include "io/scene_builder.h"
#include "io/transform.h"
#include "material/bitmap_texture.h"
#include "material/checkerboard_texture.h"

namespace brume {
namespace {

// The part of `to_uv` that moves (u, v, 1).
glm::mat3 uv_transform(const SceneNode& node) {
  glm::dmat4 m = node.transform("to_uv");
  if (node.old_dialect) {
    const auto value = [&](const char* name, double fallback) {
      return node.number(name, fallback);
    };
    m = m * scaling({value("uscale", 1.0), value("vscale", 1.0), 1.0}) *
        translation({value("uoffset", 0.0), value("voffset", 0.0), 0.0});
  }
  return {glm::vec3(m[0].x, m[0].y, 0.0f), glm::vec3(m[1].x, m[1].y, 0.0f),
          glm::vec3(m[3].x, m[3].y, 1.0f)};
}

std::shared_ptr<const Texture> build_bitmap(const SceneNode& node, BuildContext& context) {
  using Filter = BitmapTexture::Filter;
  using Wrap = BitmapTexture::Wrap;
  const std::filesystem::path path = node.file("filename");
  const bool is_nearest = node.choice("filter_type", {"bilinear", "nearest"}) == "nearest";
  const std::string wrap = node.choice("wrap_mode", {"repeat", "mirror", "clamp"});
  const bool is_raw = node.boolean("raw", false);
  const glm::mat3 to_uv = uv_transform(node);
  context.accept(node, {"format", "accel"});

  const Image image =
      read_image(path.string(), is_raw ? IntegerEncoding::kLinear : IntegerEncoding::kSrgb);
  std::vector<Rgb> pixels;
  pixels.reserve(std::size_t(image.width) * std::size_t(image.height));
  const std::size_t r = *image.channel("R"), g = *image.channel("G"), b = *image.channel("B");
  std::size_t clamped = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb c(image.at(x, y, r), image.at(x, y, g), image.at(x, y, b));
      pixels.push_back(glm::clamp(c, 0.0f, 1.0f));
      if (pixels.back() != c) ++clamped;
    }
  }
  if (clamped > 0) {
    context.notices.warn(
        fmt::format("{}: {} pixels outside [0, 1] are clamped: a texture holds reflectances",
                    path.string(), clamped));
  }
  return std::make_shared<BitmapTexture>(std::move(pixels), image.width, image.height,
                                         is_nearest ? Filter::kNearest : Filter::kBilinear,
                                         wrap == "repeat"   ? Wrap::kRepeat
                                         : wrap == "mirror" ? Wrap::kMirror
                                                            : Wrap::kClamp,
                                         to_uv);
}

std::shared_ptr<const Texture> build_checkerboard(const SceneNode& node, BuildContext& context) {
  return std::make_shared<CheckerboardTexture>(texture_parameter(node, "color0", 0.4, context),
                                               texture_parameter(node, "color1", 0.2, context),
                                               uv_transform(node));
}

using Build = std::shared_ptr<const Texture> (*)(const SceneNode&, BuildContext&);
constexpr Plugin<Build> kTextures[] = {{"bitmap", build_bitmap},
                                       {"checkerboard", build_checkerboard}};

}  // namespace

std::shared_ptr<const Texture> build_texture(const SceneNode& node, BuildContext& context) {
  std::shared_ptr<const Texture>& texture = context.textures[&node];
  if (texture == nullptr) {
    texture = find_plugin(node, kTextures)(node, context);
    node.finish();
  }
  return texture;
}

std::shared_ptr<const Texture> texture_parameter(const SceneNode& node, std::string_view name,
                                                 double fallback, BuildContext& context) {
  if (const SceneNode* child = node.named_child("texture", name)) {
    return build_texture(*child, context);
  }
  return std::make_shared<ConstantTexture>(node.colour(name, fallback, ColourUse::kReflectance));
}

}  // namespace brume
