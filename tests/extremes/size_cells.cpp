// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell.h"
#include "scene_text.h"
#include "size_scene.h"

// The same scene a micrometre and a light-year wide, and far away from the origin.

namespace brume::test {

std::string size_scene(double size, const glm::dvec3& center) {
  const auto at = [&](double x, double y, double z) { return center + size * glm::dvec3(x, y, z); };
  const double sigma_t = 1.0 / size;
  std::string body = camera({.origin = at(0, 0.5, -4), .target = at(0, 0, 0), .fov_deg = 45.0});
  body += fmt::format(
      "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/>"
      "<scale value=\"{}\"/><translate value=\"{}\"/></transform></shape>\n",
      3.0 * size, text(at(0, -1.25, 0)));
  body += cube(at(-2, -1, -1), at(1, 1, 1.5), kNull + homogeneous(sigma_t, 0.8, 0.5, "interior"));
  body += sphere(at(-0.5, -0.25, 0), 0.5 * size, "<bsdf type=\"dielectric\"/>");
  body += sphere(at(-1.25, 0.5, 0.5), 0.25 * size,
                 "<emitter type=\"area\"><float name=\"radiance\" value=\"3\"/></emitter>");
  const glm::dvec3 lo = at(1.25, -1, -1), hi = at(2.25, 1, 1);
  body += cube(lo, hi,
               kNull + heterogeneous(constant_volume(2.0, lo, hi), sigma_t, "1, 0.9, 0.7", -0.3,
                                     "interior"));
  body += fmt::format(
      "<emitter type=\"point\"><point name=\"position\" value=\"{}\"/><float name=\"intensity\" "
      "value=\"{}\"/></emitter>\n",
      text(at(1, 2, -1)), 2.0 * size * size);
  body += fmt::format(
      "<emitter type=\"spot\"><float name=\"intensity\" value=\"{}\"/><float name=\"cutoff_angle\" "
      "value=\"30\"/><transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" "
      "up=\"0,0,1\"/>"
      "</transform></emitter>\n",
      4.0 * size * size, text(at(-1, 3, 0)), text(at(0, 0, 0)));
  body += "<emitter type=\"directional\"><vector name=\"direction\" value=\"1,-1,2\"/></emitter>\n";
  return scene(body + environment(0.25), 12);
}

namespace {

/// Light from a slab of optical thickness 2 in a uniform environment (adding-doubling).
constexpr double kIsotropicSlab = 0.361649 + 0.356501;

std::string view_of(const glm::dvec3& center) {
  return camera({.origin = center + glm::dvec3(0, 0, -3), .target = center});
}

/// A cube of optical thickness 2 in a uniform environment.
std::string absorbing_cube(const glm::dvec3& center) {
  return cube(center - 1.0, center + 1.0, kNull + homogeneous(1, 0, 0, "interior")) + environment();
}

}  // namespace

std::vector<Cell> cells_of_size() {
  std::vector<Cell> cells;
  for (const int exponent : {-15, -9, -6, -3, 0, 3, 6, 9, 12, 15}) {
    const double size = std::pow(10.0, exponent);
    cells.push_back({.axis = "size",
                     .at = size,
                     .name = fmt::format("Size{}{}", exponent < 0 ? "m" : "", std::abs(exponent)),
                     .scene = size_scene(size, {0, 0, 0}),
                     .like = size_scene(1.0, {0, 0, 0}),
                     .blocks = 1024});
  }
  for (const double offset : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
    cells.push_back({.axis = "offset from the origin, in sizes",
                     .at = offset,
                     .name = fmt::format("Offset{:.0f}", offset),
                     .scene = size_scene(1.0, offset * glm::dvec3(1.0, -0.7, 0.4)),
                     .like = size_scene(1.0, {0, 0, 0}),
                     .blocks = 1024});
    const glm::dvec3 center = offset * glm::dvec3(1.0, -0.7, 0.4);
    cells.push_back(
        {.axis = "offset from the origin, furnace",
         .at = offset,
         .name = fmt::format("OffsetFurnace{:.0f}", offset),
         .scene =
             scene(view_of(center) +
                   sphere(center, 1.0, kNull + homogeneous(2, 1, 0.5, "interior")) + environment()),
         .want = glm::dvec3(1.0)});
    cells.push_back({.axis = "offset from the origin, Beer-Lambert",
                     .at = offset,
                     .name = fmt::format("OffsetBeer{:.0f}", offset),
                     .scene = scene(view_of(center) + absorbing_cube(center)),
                     .central_ray = true,
                     .want = glm::dvec3(std::exp(-2.0)),
                     .blocks = 1});
    const glm::dvec3 lo = center - glm::dvec3(50, 50, 0), hi = center + glm::dvec3(50, 50, 1);
    cells.push_back(
        {.axis = "offset from the origin, slab of albedo 0.9",
         .at = offset,
         .name = fmt::format("OffsetSlab{:.0f}", offset),
         .scene = scene(
             camera({.origin = center + glm::dvec3(0, 0, -3), .target = center, .fov_deg = 1.0}) +
             cube(lo, hi, kNull + homogeneous(2, 0.9, 0, "interior")) + environment()),
         .want = glm::dvec3(kIsotropicSlab),
         .blocks = 1024});
  }

  // Where a wide scene holds a body far from its middle, floats lose its digits: a ray leaves a
  // surface by up to 3.5 times their relative precision 2^-24.
  for (const double offset : {1e1, 1e2, 1e3, 1e4}) {
    const glm::dvec3 center = offset * glm::dvec3(1.0, 0.7, 0.4);
    cells.push_back(
        {.axis = "offset in a wide scene, Beer-Lambert",
         .at = offset,
         .name = fmt::format("FarInWideScene{:.0f}", offset),
         .scene = scene(view_of(center) + absorbing_cube(center) + sphere({0, -1e5, 0}, 1e5, "")),
         .central_ray = true,
         .want = glm::dvec3(std::exp(-2.0)),
         .rounding = 1e-5 + 3.5 * 0x1p-24 * offset,
         .blocks = 1});
  }
  return cells;
}

}  // namespace brume::test
