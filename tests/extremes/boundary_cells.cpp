// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell.h"
#include "scene_text.h"

// Boundaries on top of each other, inside each other and across each other; fog without a way out.

namespace brume::test {
namespace {

std::string shining_room(const glm::dvec3& lo, const glm::dvec3& hi) {
  return cube(lo, hi,
              "<boolean name=\"flip_normals\" value=\"true\"/><emitter type=\"area\"><float "
              "name=\"radiance\" value=\"1\"/></emitter>");
}

std::string white_room(const glm::dvec3& lo, const glm::dvec3& hi) {
  return cube(lo, hi,
              "<boolean name=\"flip_normals\" value=\"true\"/><bsdf type=\"diffuse\"><rgb "
              "name=\"reflectance\" value=\"1\"/></bsdf>");
}

void add(std::vector<Cell>& cells, const std::string& axis, const std::string& name, double at,
         const std::string& scene, std::optional<double> want, bool central_ray, int blocks = 256) {
  cells.push_back({.axis = axis,
                   .at = at,
                   .name = name,
                   .scene = scene,
                   .central_ray = central_ray,
                   .want = want ? std::optional(glm::dvec3(*want)) : std::nullopt,
                   .blocks = blocks});
}

}  // namespace

std::vector<Cell> cells_of_boundaries() {
  std::vector<Cell> cells;

  for (const int exponent : {-6, -3, 0}) {
    const double r = 0.5 * std::pow(10.0, exponent);
    for (const char* bsdf : {"dielectric", "thindielectric", "roughdielectric"})
      add(cells, "radius of a glass ball in fog, furnace", fmt::format("{}{}", bsdf, -exponent), r,
          scene(camera({.origin = {0, 0, -3 * r}, .target = {0, 0, 0}}) +
                sphere({0, 0, 0}, r, fmt::format("<bsdf type=\"{}\"/>", bsdf)) +
                sphere({0, 0, 0}, 2, kNull + homogeneous(1, 1, 0, "interior")) + environment()),
          std::string(bsdf) == "roughdielectric" ? std::nullopt : std::optional(1.0), false);
  }

  // Fog that ends exactly where the walls stand, whichever is named first.
  const glm::dvec3 lo(-1, -1, -1), hi(1, 1, 1);
  const std::string middle =
      camera({.origin = {0.1, 0, 0.2}, .target = {0.1, 0, 1}, .fov_deg = 60});
  const auto fog = [&](double albedo) {
    return cube(lo, hi, kNull + homogeneous(1, albedo, 0, "interior"));
  };
  add(cells, "fog up to the walls, furnace", "FogThenWalls", 1,
      scene(middle + fog(1) + shining_room(lo, hi)), 1.0, false);
  add(cells, "fog up to the walls, furnace", "WallsThenFog", 1,
      scene(middle + shining_room(lo, hi) + fog(1)), 1.0, false);
  add(cells, "fog up to the walls, Beer-Lambert", "FogThenWallsBeer", 1,
      scene(middle + fog(0) + shining_room(lo, hi)), std::exp(-0.8), true, 1);
  add(cells, "fog up to the walls, Beer-Lambert", "WallsThenFogBeer", 1,
      scene(middle + shining_room(lo, hi) + fog(0)), std::exp(-0.8), true, 1);
  for (const bool walls_first : {false, true}) {
    const std::string walls = white_room(lo, hi), medium = fog(1);
    const std::string lamp = sphere({0, 0.5, 0}, 0.2,
                                    "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                                    "value=\"0.5\"/></bsdf><emitter type=\"area\"><float "
                                    "name=\"radiance\" value=\"0.5\"/></emitter>");
    // White walls and white fog around a body that reflects half and emits the other half.
    add(cells, "fog up to the walls, furnace",
        walls_first ? "WhiteWallsThenFog" : "FogThenWhiteWalls", 2,
        scene(middle + lamp + (walls_first ? walls + medium : medium + walls)), 1.0, false, 64);
  }

  // Two boxes of fog, one face in common.
  const std::string along = camera({.origin = {-3, 0.1, 0.2}, .target = {0, 0.1, 0.2}});
  const std::string against = camera({.origin = {3, 0.1, 0.2}, .target = {0, 0.1, 0.2}});
  const auto left = [&](double albedo) {
    return cube({-1, -1, -1}, {0, 1, 1}, kNull + homogeneous(0.5, albedo, 0, "interior"));
  };
  const auto right = [&](double albedo) {
    return cube({0, -1, -1}, {1, 1, 1}, kNull + homogeneous(2, albedo, 0, "interior"));
  };
  for (const bool is_along : {true, false})
    for (const bool left_first : {true, false})
      for (const double albedo : {0.0, 1.0}) {
        const std::string boxes =
            left_first ? left(albedo) + right(albedo) : right(albedo) + left(albedo);
        add(cells, "boxes that share a face",
            fmt::format("Shared{}{}Albedo{:.0f}", is_along ? "Along" : "Against",
                        left_first ? "LeftFirst" : "RightFirst", albedo),
            1, scene((is_along ? along : against) + boxes + environment()),
            albedo == 0.0 ? std::exp(-2.5) : 1.0, albedo == 0.0);
      }

  // One inside the other, and one across the other.
  const std::string view = camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .fov_deg = 45});
  for (const double albedo : {0.0, 1.0}) {
    add(cells, "nested media", fmt::format("NestedAlbedo{:.0f}", albedo), 1,
        scene(view + sphere({0, 0, 0}, 1, kNull + homogeneous(1, albedo, 0, "interior")) +
              sphere({0, 0, 0}, 0.5,
                     kNull + homogeneous(3, albedo, 0, "interior") +
                         homogeneous(1, albedo, 0, "exterior")) +
              environment()),
        albedo == 0.0 ? std::exp(-1.0 - 3.0) : 1.0, albedo == 0.0);
    add(cells, "overlapping media", fmt::format("OverlapAlbedo{:.0f}", albedo), 1,
        scene(view + sphere({0, 0, -0.3}, 0.8, kNull + homogeneous(1, albedo, 0, "interior")) +
              sphere({0, 0, 0.3}, 0.8, kNull + homogeneous(3, albedo, 0, "interior")) +
              environment()),
        std::nullopt, false);
    add(cells, "overlapping media", fmt::format("TwiceTheSameAlbedo{:.0f}", albedo), 2,
        scene(view + sphere({0, 0, 0}, 1, kNull + homogeneous(1, albedo, 0, "interior")) +
              sphere({0, 0, 0}, 1, kNull + homogeneous(1, albedo, 0, "interior")) + environment()),
        albedo == 0.0 ? std::exp(-2.0) : 1.0, albedo == 0.0);
  }

  // No way out.
  const std::string open_view = camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .far = 1e30});
  for (const double sigma_t : {1e-8, 1.0, 1e8})
    add(cells, "fog everywhere, albedo 1", "Everywhere" + number_name(sigma_t), sigma_t,
        scene(open_view + homogeneous(sigma_t, 1, 0) + environment()), std::nullopt, false, 2);
  add(cells, "fog everywhere, albedo 1", "ClosedWhiteRoom", 1,
      scene(middle + white_room({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}) + fog(1)), 0.0, false, 2);
  add(cells, "fog everywhere, albedo 1", "BackAndForth", 1,
      scene(open_view + homogeneous(1, 1, -1) + environment()), std::nullopt, false, 2);
  add(cells, "fog everywhere, albedo 1", "StraightOn", 1,
      scene(open_view + homogeneous(1, 1, 1) + environment()), std::nullopt, false, 2);
  return cells;
}

}  // namespace brume::test
