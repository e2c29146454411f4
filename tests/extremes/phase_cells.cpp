// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell.h"
#include "scene_text.h"

// Scattering that keeps the direction, reverses it, or all but does.

namespace brume::test {
namespace {

/// What a slab of optical thickness `tau` shows in a uniform environment of radiance 1 when light
/// scatters straight back only: reflectance and transmittance of the two streams along the ray.
double two_streams(double tau, double albedo) {
  if (albedo == 1.0) return 1.0;
  const double k = std::sqrt(1.0 - albedo * albedo);
  const double tanh = std::tanh(k * tau);
  return (k / std::cosh(k * tau) + albedo * tanh) / (k + tanh);
}

/// At normal incidence, one unit thick, sigma_t 2 (adding-doubling).
constexpr double kIsotropicSlab = 0.361649 + 0.356501;

}  // namespace

std::vector<Cell> cells_of_phase() {
  std::vector<Cell> cells;
  const std::string view = camera({.origin = {0, 0, -3}, .target = {0, 0, 0}, .fov_deg = 1.0});
  const glm::dvec3 lo(-50, -50, 0), hi(50, 50, 1);
  int index = 0;
  for (const double g : {-1.0, -0.999999, -1e-6, -1e-30, 0.0, 1e-30, 1e-6, 0.999999, 1.0}) {
    for (const double albedo : {0.0, 0.9, 1.0}) {
      for (const double sigma_t : {2.0, 5.0}) {
        std::optional<glm::dvec3> want;
        if (albedo == 0.0)
          want = glm::dvec3(std::exp(-sigma_t));
        else if (g > 0.99)
          want = glm::dvec3(std::exp(-sigma_t * (1.0 - albedo)));
        else if (g < -0.99)
          want = glm::dvec3(two_streams(sigma_t, albedo));
        else if (albedo == 1.0)
          want = glm::dvec3(1.0);
        else if (sigma_t == 2.0)
          want = glm::dvec3(kIsotropicSlab);
        for (const bool is_grid : {false, true}) {
          cells.push_back(
              {.axis = fmt::format("g, {} of sigma_t {} and albedo {}", is_grid ? "grid" : "slab",
                                   sigma_t, albedo),
               .at = g,
               .name = fmt::format("Phase{}G{}Albedo{}SigmaT{}", is_grid ? "Grid" : "Slab", index,
                                   int(10 * albedo), int(sigma_t)),
               .scene = scene(
                   view +
                   (is_grid ? heterogeneous(constant_volume(sigma_t, lo, hi), 1.0,
                                            fmt::format("{}", albedo), g)
                            : cube(lo, hi, kNull + homogeneous(sigma_t, albedo, g, "interior"))) +
                   environment()),
               .central_ray = albedo == 0.0,
               .want = want,
               .rounding = 2e-4});
        }
      }
    }
    ++index;
  }

  // A lamp that shines through the slab on a floor: light that goes on straight was not scattered.
  for (const bool is_grid : {false, true})
    cells.push_back(
        {.axis = "g, point light through a medium",
         .at = 1.0,
         .name = is_grid ? "ForwardGridPointLight" : "ForwardSlabPointLight",
         .scene = scene(
             camera({.origin = {0, 0.5, 0}, .target = {0, -1, 0}, .up = {0, 0, 1}}) +
             R"(<emitter type="point"><point name="position" value="0, 3, 0"/></emitter>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/>
<scale value="9"/><translate y="-1"/></transform></shape>)" +
             (is_grid ? heterogeneous(constant_volume(2.0, {-9, 1, -9}, {9, 2, 9}), 1.0, "0.9", 1)
                      : cube({-9, 1, -9}, {9, 2, 9}, kNull + homogeneous(2, 0.9, 1, "interior")))),
         .central_ray = true,
         .want = glm::dvec3(0.5 / M_PI / 16.0 * std::exp(-0.2))});
  return cells;
}

}  // namespace brume::test
