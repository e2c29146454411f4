// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "geometry/cube.h"
#include "geometry/cylinder.h"
#include "geometry/disk.h"
#include "geometry/rectangle.h"
#include "geometry/similarity.h"
#include "geometry/sphere.h"
#include "geometry/triangle_mesh.h"
#include "io/mesh_file.h"
#include "io/scene_builder.h"
#include "material/diffuse_bsdf.h"
#include "material/null_bsdf.h"

namespace brume {
namespace {

using ShapePtr = std::shared_ptr<const Shape>;

Similarity similarity(const SceneNode& node, const BuildContext& context) {
  if (const auto s = as_similarity(context.to_world(node))) return *s;
  fail_at(node.position("to_world"),
          fmt::format("to_world of {} must move, turn, mirror and scale all axes alike; use an obj "
                      "or ply mesh for other forms",
                      node.label()));
}

ShapePtr build_sphere(const SceneNode& node, const BuildContext& context) {
  const Similarity to_world = similarity(node, context);
  const glm::dvec3 center = node.vec3("center", glm::dvec3(0.0));
  const double radius = node.number("radius", 1.0, kPositive) * to_world.scale;
  return std::make_shared<Sphere>(
      Vec3(to_world.offset + to_world.scale * (to_world.rotation * center)), float(radius),
      node.boolean("flip_normals", false), glm::mat3(to_world.rotation));
}

ShapePtr build_cylinder(const SceneNode& node, const BuildContext& context) {
  const glm::dvec3 p0 = node.vec3("p0", glm::dvec3(0.0));
  const glm::dvec3 p1 = node.vec3("p1", glm::dvec3(0.0, 0.0, 1.0));
  if (p0 == p1) node.fail(fmt::format("p0 and p1 of {} are the same point", node.label()));
  Similarity from_p0 = similarity(node, context);
  from_p0.offset += from_p0.scale * (from_p0.rotation * p0);
  return std::make_shared<Cylinder>(Vec3(0.0f), Vec3(p1 - p0),
                                    float(node.number("radius", 1.0, kPositive)), from_p0,
                                    node.boolean("flip_normals", false));
}

template <class Patch>
ShapePtr build_patch(const SceneNode& node, const BuildContext& context) {
  return std::make_shared<Patch>(context.to_world(node), node.boolean("flip_normals", false));
}

ShapePtr build_mesh(const SceneNode& node, MeshData mesh, bool flips_v,
                    const BuildContext& context) {
  if (node.boolean("flip_tex_coords", flips_v)) {
    for (Vec2& uv : mesh.uvs) uv.y = 1.0f - uv.y;
  }
  return std::make_shared<TriangleMesh>(std::move(mesh), context.to_world(node),
                                        node.boolean("face_normals", false),
                                        node.boolean("flip_normals", false));
}

// Files of either kind have v = 0 at the bottom or at the top of a texture; these are the habits
// that Mitsuba assumes.
ShapePtr build_obj(const SceneNode& node, const BuildContext& context) {
  return build_mesh(node, read_obj(node.file("filename")), true, context);
}
ShapePtr build_ply(const SceneNode& node, const BuildContext& context) {
  return build_mesh(node, read_ply(node.file("filename")), false, context);
}

constexpr Plugin<ShapePtr (*)(const SceneNode&, const BuildContext&)> kShapes[] = {
    {"obj", build_obj},          {"ply", build_ply},
    {"sphere", build_sphere},    {"rectangle", build_patch<Rectangle>},
    {"cube", build_patch<Cube>}, {"disk", build_patch<Disk>},
    {"cylinder", build_cylinder}};

Rgb area_radiance(const SceneNode& emitter) {
  if (emitter.type != "area") {
    fail_at(emitter.type_at, fmt::format("a shape takes an emitter of type \"area\", not \"{}\"; "
                                         "others belong directly in the scene",
                                         emitter.type));
  }
  const Rgb radiance = emitter.colour("radiance", 1.0, ColourUse::kEmission);
  emitter.finish();
  return radiance;
}

std::shared_ptr<const Bsdf> default_bsdf(const SceneNode& shape, const Surface& surface) {
  // Before version 2 a shape with a medium and no bsdf or light is an index-matched boundary.
  if (shape.old_dialect && surface.is_boundary && !surface.radiance) {
    return std::make_shared<NullBsdf>();
  }
  const Rgb reflectance(surface.radiance ? 0.0f : 0.5f);
  return std::make_shared<DiffuseBsdf>(std::make_shared<ConstantTexture>(reflectance));
}

}  // namespace

Surface build_surface(const SceneNode& node, BuildContext& context) {
  Surface surface;
  if (const SceneNode* emitter = node.only_child("emitter")) {
    surface.radiance = area_radiance(*emitter);
  }
  const SceneNode* interior = node.named_child("medium", "interior");
  const SceneNode* exterior = node.named_child("medium", "exterior");
  if (interior != nullptr) surface.interior = build_medium(*interior, context);
  if (exterior != nullptr) surface.exterior = build_medium(*exterior, context);
  surface.is_boundary = interior != nullptr || exterior != nullptr;
  const SceneNode* bsdf = node.only_child("bsdf");
  surface.bsdf = bsdf != nullptr ? build_bsdf(*bsdf, context) : default_bsdf(node, surface);
  context.accept(node, {"silhouette_sampling_weight"});
  surface.shape = find_plugin(node, kShapes)(node, context);
  context.placed.extend(surface.shape->bounds());
  node.finish();
  return surface;
}

}  // namespace brume
