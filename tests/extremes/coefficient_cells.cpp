// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell.h"
#include "scene_text.h"

// Extinctions, albedos and densities from nothing to everything.

namespace brume::test {
namespace {

constexpr double kExtinctions[] = {1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8};

std::string ball_view() {
  return camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .fov_deg = 45.0});
}
std::string in_ball(const std::string& medium) {
  return sphere({0, 0, 0}, 1.0, kNull + medium);
}

/// Slab one unit thick, a hundred wide, seen along its normal.
std::string slab(const std::string& medium, const std::string& lights) {
  return scene(camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .fov_deg = 1.0}) +
               cube({-50, -50, 0}, {50, 50, 1}, kNull + medium) + lights);
}

/// Sum of reflectance and transmittance of the slab at albedo 0.9, isotropic (adding-doubling; a
/// half-space reflects 1 - H(1) sqrt(0.1) (Chandrasekhar 1960)); none where it was not computed.
std::optional<glm::dvec3> light_from_slab(double tau) {
  if (tau <= 1e-6) return glm::dvec3(1.0);
  if (tau == 0.5) return glm::dvec3(0.169039 + 0.765383);
  if (tau == 2.0) return glm::dvec3(0.361649 + 0.356501);
  if (tau == 8.0) return glm::dvec3(0.414843 + 0.016020);
  if (tau >= 32.0) return glm::dvec3(0.414947);
  return std::nullopt;
}

void add_extinctions(std::vector<Cell>& cells) {
  const glm::dvec3 lo(-1.0), hi(1.0);
  for (const double sigma_t : kExtinctions) {
    const std::string at = number_name(sigma_t);
    const bool resolved = sigma_t < 1e8;  // by the rounding of coordinates three units away
    // Thin bodies scatter so seldom that a short run may see none of it.
    const double rounding = sigma_t < 1e-2 ? 1e-5 + 4.0 * sigma_t : 1e-5;
    cells.push_back({.axis = "sigma_t, furnace of a ball",
                     .at = sigma_t,
                     .name = "BallFurnace" + at,
                     .scene = scene(ball_view() + in_ball(homogeneous(sigma_t, 1, 0, "interior")) +
                                    environment()),
                     .want = glm::dvec3(1.0),
                     .rounding = rounding});
    cells.push_back(
        {.axis = "sigma_t, furnace of a grid",
         .at = sigma_t,
         .name = "GridFurnace" + at,
         .scene = scene(ball_view() + heterogeneous(constant_volume(sigma_t, lo, hi), 1.0, "1", 0) +
                        environment()),
         .want = glm::dvec3(1.0),
         .rounding = rounding});
    cells.push_back({.axis = "sigma_t, Beer-Lambert through a ball",
                     .at = sigma_t,
                     .name = "BallBeer" + at,
                     .scene = scene(ball_view() + in_ball(homogeneous(sigma_t, 0, 0, "interior")) +
                                    environment()),
                     .central_ray = true,
                     .want = glm::dvec3(std::exp(-2.0 * sigma_t)),
                     .blocks = 1});
    cells.push_back(
        {.axis = "sigma_t, Beer-Lambert through a grid",
         .at = sigma_t,
         .name = "GridBeer" + at,
         .scene = scene(ball_view() + heterogeneous(constant_volume(sigma_t, lo, hi), 1.0, "0", 0) +
                        environment()),
         .central_ray = true,
         .want = glm::dvec3(std::exp(-2.0 * sigma_t))});
    cells.push_back({.axis = "sigma_t, slab of albedo 0.9",
                     .at = sigma_t,
                     .name = "Slab" + at,
                     .scene = slab(homogeneous(sigma_t, 0.9, 0, "interior"), environment()),
                     .want = light_from_slab(sigma_t)});
    cells.push_back(
        {.axis = "sigma_t, slab of albedo 0.9 in a grid",
         .at = sigma_t,
         .name = "GridSlab" + at,
         .scene = scene(
             camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .fov_deg = 1.0}) +
             heterogeneous(constant_volume(sigma_t, {-50, -50, 0}, {50, 50, 1}), 1.0, "0.9", 0) +
             environment()),
         .want = resolved ? light_from_slab(sigma_t) : std::nullopt});
  }
}

/// 4/3 sigma_t scatterings on average, some paths have thousands of times as many.
void add_many_scatterings(std::vector<Cell>& cells) {
  for (const double sigma_t : {30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0})
    cells.push_back(
        {.axis = "scatterings in a ball of albedo 1",
         .at = 4.0 / 3.0 * sigma_t,
         .name = "Scatterings" + number_name(sigma_t),
         .scene = scene(camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .fov_deg = 1}) +
                        in_ball(homogeneous(sigma_t, 1, 0, "interior")) + environment()),
         .want = glm::dvec3(1.0)});
}

/// Density times scale is 2 in all of them.
void add_densities(std::vector<Cell>& cells) {
  const glm::dvec3 lo(-1.0), hi(1.0);
  for (const double density : {1e-37, 1e-30, 1e-20, 1e-10, 1.0, 1e10, 1e20, 1e30, 1e38})
    for (const double albedo : {0.0, 1.0})
      cells.push_back({.axis = albedo == 0.0 ? "density, Beer-Lambert" : "density, furnace",
                       .at = density,
                       .name = fmt::format("Density{}Albedo{:.0f}", number_name(density), albedo),
                       .scene = scene(ball_view() +
                                      heterogeneous(constant_volume(density, lo, hi), 2.0 / density,
                                                    fmt::format("{}", albedo), 0) +
                                      environment()),
                       .central_ray = albedo == 0.0,
                       .want = glm::dvec3(albedo == 0.0 ? std::exp(-4.0) : 1.0)});
  // As they are: nothing, and a wall.
  for (const double density : {1e-30, 1e30}) {
    for (const double albedo : {0.0, 1.0}) {
      std::optional<glm::dvec3> want;  // a path cannot leave a wall whose free paths round to 0
      if (density < 1.0)
        want = glm::dvec3(1.0);
      else if (albedo == 0.0)
        want = glm::dvec3(0.0);
      cells.push_back({.axis = "density without scale",
                       .at = density,
                       .name = fmt::format("Unscaled{}Albedo{:.0f}", number_name(density), albedo),
                       .scene = scene(ball_view() +
                                      heterogeneous(constant_volume(density, lo, hi), 1.0,
                                                    fmt::format("{}", albedo), 0) +
                                      environment()),
                       .central_ray = true,
                       .want = want,
                       .blocks = 4});
    }
  }
}

void add_colours(std::vector<Cell>& cells) {
  struct Colour {
    const char* name;
    glm::dvec3 sigma_t, albedo;
  };
  const Colour colours[] = {
      {"NoRed", {0, 1, 2}, {1, 1, 1}},          {"OnlyBlue", {0, 0, 5}, {1, 1, 1}},
      {"RedLikeAWall", {1e3, 1, 0}, {1, 1, 1}}, {"FarApart", {1e-8, 1, 1e2}, {1, 1, 1}},
      {"BlackGreen", {1, 1, 1}, {1, 0, 1}},     {"AllButNothing", {1e-30, 1e-30, 1}, {1, 1, 1}}};
  const glm::dvec3 lo(-1.0), hi(1.0);
  for (const Colour& c : colours) {
    // Channels whose albedo is 0 are known along a ray through the middle only.
    const bool is_white = c.albedo == glm::dvec3(1.0);
    cells.push_back(
        {.axis = "colours, ball",
         .at = glm::length(c.sigma_t),
         .name = fmt::format("Ball{}", c.name),
         .scene = scene(ball_view() +
                        in_ball(homogeneous(text(c.sigma_t), text(c.albedo), 0, "interior")) +
                        environment()),
         .central_ray = !is_white,
         .want = is_white ? glm::dvec3(1.0) : glm::dvec3(1.0, std::exp(-2.0 * c.sigma_t.y), 1.0)});
    cells.push_back(
        {.axis = "colours, grid",
         .at = glm::length(c.sigma_t),
         .name = fmt::format("Grid{}", c.name),
         .scene =
             scene(ball_view() +
                   heterogeneous(fmt::format("<volume name=\"sigma_t\" type=\"constvolume\"><rgb "
                                             "name=\"value\" value=\"{}\"/>{}</volume>",
                                             text(c.sigma_t), from_unit_box(lo, hi)),
                                 1.0, text(c.albedo), 0) +
                   environment()),
         .central_ray = !is_white,
         .want = is_white ? glm::dvec3(1.0) : glm::dvec3(1.0, std::exp(-2.0 * c.sigma_t.y), 1.0)});
  }
}

}  // namespace

std::vector<Cell> cells_of_coefficients() {
  std::vector<Cell> cells;
  add_extinctions(cells);
  add_many_scatterings(cells);
  add_densities(cells);
  add_colours(cells);
  return cells;
}

}  // namespace brume::test
