// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell.h"
#include "scene_text.h"

// Lights of any size, near and far, alone and deep inside a medium.

namespace brume::test {
namespace {

/// A white wall of the xz plane, seen from slightly above.
const std::string kFloor =
    "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/><scale "
    "value=\"0.01\"/></transform><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1\"/>"
    "</bsdf></shape>\n";

std::string floor_view() {
  return camera({.origin = {0.002, 0.001, 0}, .target = {0, 0, 0}, .fov_deg = 0.01});
}

std::string area_emitter(double radiance) {
  return fmt::format("<emitter type=\"area\"><float name=\"radiance\" value=\"{}\"/></emitter>",
                     radiance);
}

std::string facing_down(const char* type, double scale, double y, const std::string& inside) {
  return fmt::format(
      "<shape type=\"{}\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/><scale "
      "value=\"{}\"/><translate y=\"{}\"/></transform>{}</shape>\n",
      type, scale, y, inside);
}

/// Along the diameter of a ball of radius 1 in an environment of radiance 1: light that was
/// scattered once at most, isotropically, with albedo 1; by the midpoint rule.
double scattered_once_at_most(double sigma_t) {
  constexpr int n = 2000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = 2.0 * (i + 0.5) / n, r = std::abs(s - 1.0);
    double mean_T = 0.0;
    for (int j = 0; j < n; ++j) {
      const double mu = 2.0 * (j + 0.5) / n - 1.0;
      mean_T += std::exp(-sigma_t * (std::sqrt(1.0 - r * r * (1.0 - mu * mu)) - r * mu)) / n;
    }
    sum += 2.0 / n * sigma_t * std::exp(-sigma_t * s) * mean_T;
  }
  return std::exp(-2.0 * sigma_t) + sum;
}

}  // namespace

std::vector<Cell> cells_of_lights() {
  std::vector<Cell> cells;

  // Irradiance of a disk of radiance L and radius r at distance d along its axis: pi L
  // r^2/(r^2+d^2), of a ball pi L (r/d)^2, of a point I/d^2. The floor reflects E / pi.
  for (const int exponent : {-18, -12, -8, -6, -3, 0, 3, 6, 8, 12, 18}) {
    const double r = std::pow(10.0, exponent);
    const std::string at = fmt::format("{}{}", exponent < 0 ? "m" : "", std::abs(exponent));
    const double fraction = r * r / (r * r + 1.0);
    cells.push_back({.axis = "radius of a disk light over its distance",
                     .at = r,
                     .name = "DiskLight" + at,
                     .scene = scene(floor_view() + kFloor +
                                    facing_down("disk", r, 1.0, area_emitter(1.0 / fraction))),
                     .central_ray = true,
                     .want = glm::dvec3(1.0),
                     .rounding = 1e-4,
                     .blocks = 1024});
    cells.push_back({.axis = "width of a square light over its distance",
                     .at = r,
                     .name = "SquareLight" + at,
                     .scene = scene(floor_view() + kFloor +
                                    facing_down("rectangle", r, 1.0, area_emitter(1.0 / fraction))),
                     .central_ray = true,
                     .want = exponent < -2                   ? std::optional(glm::dvec3(4.0 / M_PI))
                             : exponent > 2 && exponent <= 8 ? std::optional(glm::dvec3(1.0))
                                                             : std::nullopt,
                     .rounding = 1e-4,
                     .blocks = 1024});
    const double radius = exponent <= 0 ? 0.9 * r : r, height = exponent <= 0 ? 1.0 : 1.5 * r;
    cells.push_back({.axis = "radius of a ball light over its distance",
                     .at = radius,
                     .name = "BallLight" + at,
                     .scene = scene(floor_view() + kFloor +
                                    sphere({0, height, 0}, radius,
                                           area_emitter(height * height / (radius * radius)))),
                     .central_ray = true,
                     .want = glm::dvec3(1.0),
                     .rounding = 1e-4,
                     .blocks = 1024});
    cells.push_back(
        {.axis = "distance of a point light",
         .at = r,
         .name = "PointLight" + at,
         .scene = scene(floor_view() + kFloor +
                        fmt::format("<emitter type=\"point\"><point name=\"position\" value=\"0, "
                                    "{}, 0\"/><float name=\"intensity\" value=\"{}\"/></emitter>",
                                    r, M_PI * r * r)),
         .central_ray = true,
         .want = glm::dvec3(1.0),
         .rounding = 1e-4,
         .blocks = 2});
    // An enclosure that shines inward, with a ball of fog in its middle.
    cells.push_back(
        {.axis = "size of a furnace made of a ball light",
         .at = r,
         .name = "LightFurnace" + at,
         .scene =
             scene(camera({.origin = {0, 0, -0.9 * r}, .target = {0, 0, 0}, .fov_deg = 60}) +
                   sphere({0, 0, 0}, r,
                          "<boolean name=\"flip_normals\" value=\"true\"/>" + area_emitter(1.0)) +
                   sphere({0, 0, 0}, 0.5 * r, kNull + homogeneous(3.0 / r, 1, 0.5, "interior"))),
         .want = glm::dvec3(1.0)});
  }

  // Deep inside a ball, measured in free paths, nothing tells it from space full of fog.
  for (const double sigma_t : {1e2, 1e4, 1e8}) {
    const double unit = 1.0 / sigma_t;
    const auto lit = [](double mfp, double intensity) {
      return camera({.origin = {0, 0, -mfp}, .target = {0, 0, 0}, .fov_deg = 60}) +
             fmt::format(
                 "<emitter type=\"point\"><point name=\"position\" value=\"{}, 0, 0\"/><float "
                 "name=\"intensity\" value=\"{}\"/></emitter>\n",
                 0.5 * mfp, intensity);
    };
    cells.push_back({.axis = "sigma_t around a point light",
                     .at = sigma_t,
                     .name = fmt::format("LightInside{:.0f}", sigma_t),
                     .scene = scene(lit(unit, unit * unit) +
                                        sphere({0, 0, 0}, 1.0,
                                               kNull + homogeneous(sigma_t, 0.8, 0, "interior")),
                                    20),
                     .like = scene(lit(1.0, 1.0) + homogeneous(1, 0.8, 0), 20),
                     .rounding = 1e-4,
                     .blocks = 2048});
    cells.push_back(
        {.axis = "sigma_t before a ball light",
         .at = sigma_t,
         .name = fmt::format("BallLightInside{:.0f}", sigma_t),
         .scene =
             scene(camera({.origin = {0, 0, -1.5 - unit}, .target = {0, 0, 0}, .near = 1e-30}) +
                   sphere({0, 0, 0}, 1.5, area_emitter(1.0)) +
                   sphere({0, 0, 0}, 2, kNull + homogeneous(sigma_t, 0, 0, "interior"))),
         .central_ray = true,
         .want = sigma_t < 1e6 ? std::optional(glm::dvec3(std::exp(-1.0))) : std::nullopt,
         .rounding = 1e-5 + 2.4e-7 * sigma_t,
         .blocks = 1});
    cells.push_back(
        {.axis = "sigma_t around a lamp seen from outside",
         .at = sigma_t,
         .name = fmt::format("LampInFog{:.0f}", sigma_t),
         .scene = scene(camera({.origin = {0, 0, -3}, .target = {0, 0, 0}}) +
                        sphere({0, 0, 0}, 0.1, area_emitter(1.0)) +
                        sphere({0, 0, 0}, 1, kNull + homogeneous(sigma_t, 0.99, 0, "interior"))),
         .blocks = 16});
  }

  for (const double sigma_t : {0.1, 1.0, 10.0}) {
    const auto ball = [&](int max_depth) {
      return scene(camera({.origin = {0, 0, -3}, .target = {0, 0, 0}}) +
                       sphere({0, 0, 0}, 1.0, kNull + homogeneous(sigma_t, 1, 0, "interior")) +
                       environment(),
                   max_depth);
    };
    cells.push_back({.axis = "max_depth 1",
                     .at = sigma_t,
                     .name = fmt::format("EmittedOnly{}", int(10 * sigma_t)),
                     .scene = ball(1),
                     .central_ray = true,
                     .want = glm::dvec3(std::exp(-2.0 * sigma_t))});
    cells.push_back({.axis = "max_depth 2",
                     .at = sigma_t,
                     .name = fmt::format("OneScattering{}", int(10 * sigma_t)),
                     .scene = ball(2),
                     .central_ray = true,
                     .want = glm::dvec3(scattered_once_at_most(sigma_t)),
                     .blocks = 1024});
    cells.push_back({.axis = "max_depth 0",
                     .at = sigma_t,
                     .name = fmt::format("Nothing{}", int(10 * sigma_t)),
                     .scene = ball(0),
                     .blocks = 4});
  }
  return cells;
}

}  // namespace brume::test
