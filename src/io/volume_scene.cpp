// SPDX-License-Identifier: Apache-2.0
#include "io/volume_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>

#include "camera/perspective_camera.h"
#include "core/error.h"
#include "io/volume_file.h"
#include "light/sky.h"
#include "medium/heterogeneous_medium.h"

namespace brume {
namespace {

constexpr double kFieldOfView = 35.0;      // [deg], horizontal
constexpr double kTargetThickness = 30.0;  // optical, of the thick part of the volume
constexpr float kSunElevation = 40.0f;     // [deg]
constexpr float kSunAzimuth = 125.0f;      // [deg] from the viewer's direction, to the left
constexpr float kTurbidity = 3.0f;

/// Integral of density [density * unit] along lines through the grid's voxels on all three axes,
/// such that one line in ten of those that meet anything has more.
double thick_line_integral(const Grid<float>& grid) {
  constexpr int kLinesPerSide = 64;
  const glm::ivec3 lo(glm::ceil(grid.box().min));
  const glm::ivec3 hi(glm::floor(grid.box().max));
  GridLookup<float> lookup(grid);
  std::vector<double> integrals;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double step = glm::length(glm::dvec3(grid.world_from_index()[axis]));
    const int step_u = std::max(1, (hi[u] - lo[u]) / kLinesPerSide);
    const int step_v = std::max(1, (hi[v] - lo[v]) / kLinesPerSide);
    glm::ivec3 i;
    for (i[u] = lo[u]; i[u] <= hi[u]; i[u] += step_u)
      for (i[v] = lo[v]; i[v] <= hi[v]; i[v] += step_v) {
        double sum = 0.0;
        for (i[axis] = lo[axis]; i[axis] <= hi[axis]; ++i[axis]) sum += lookup.nearest(Vec3(i));
        if (sum > 0.0) integrals.push_back(sum * step);
      }
  }
  if (integrals.empty()) return 0.0;
  const auto decile = integrals.begin() + std::ptrdiff_t(integrals.size() * 9 / 10);
  std::nth_element(integrals.begin(), decile, integrals.end());
  return *decile;
}

struct View {
  glm::dvec3 origin, target;
};

/// From in front, a little to the right and below the middle, as far away as framing the corners
/// of the volume asks for.
View frame_volume(const Grid<float>& grid, double aspect) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? grid.box().max.x : grid.box().min.x,
                      (i & 2) ? grid.box().max.y : grid.box().min.y,
                      (i & 4) ? grid.box().max.z : grid.box().min.z);
    corners.push_back(glm::dvec3(grid.world_from_index() * glm::dvec4(corner, 1.0)));
  }
  const glm::dvec3 center = 0.5 * (corners.front() + corners.back());
  const glm::dvec3 backward = glm::normalize(glm::dvec3(0.45, -0.16, 1.0));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), backward));
  const glm::dvec3 up = glm::cross(backward, right);

  const double tan_x = std::tan(glm::radians(0.5 * kFieldOfView));
  const double tan_y = tan_x / aspect;
  constexpr double kMargin = 1.04;
  double distance = 0.0;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 offset = corner - center;
    const double depth = glm::dot(offset, backward);
    distance = std::max({distance, depth + kMargin * std::abs(glm::dot(offset, right)) / tan_x,
                         depth + kMargin * std::abs(glm::dot(offset, up)) / tan_y});
  }
  return {center + distance * backward, center};
}

glm::dmat4 camera_to_world(const View& view) {
  const glm::dvec3 forward = glm::normalize(view.target - view.origin);
  const glm::dvec3 left = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), forward));
  const glm::dvec3 up = glm::cross(forward, left);
  return {glm::dvec4(left, 0.0), glm::dvec4(up, 0.0), glm::dvec4(forward, 0.0),
          glm::dvec4(view.origin, 1.0)};
}

}  // namespace

LoadedScene make_volume_scene(const VolumeSceneOptions& options, Notices& notices) {
  const auto grid = load_scalar_grid({.path = options.path, .grid = options.grid}, notices);
  const double aspect = double(options.size.x) / options.size.y;
  const View view = frame_volume(*grid, aspect);
  notices.note(
      fmt::format("camera at ({:.4g}, {:.4g}, {:.4g}) looks at ({:.4g}, {:.4g}, "
                  "{:.4g}), {} degrees wide",
                  view.origin.x, view.origin.y, view.origin.z, view.target.x, view.target.y,
                  view.target.z, kFieldOfView));

  const double integral = thick_line_integral(*grid);
  float scale = 1.0f;
  if (options.density_scale) {
    scale = *options.density_scale;
  } else if (integral > 0.0) {
    scale = float(kTargetThickness / integral);
  }
  const std::string origin =
      options.density_scale ? "as given" : "chosen for this; --density-scale changes it";
  notices.note(
      fmt::format("density scale {:.4g} ({}): optical thickness {:.3g} through the "
                  "thick part; albedo {:g}, {:g}, {:g}; g {:g}",
                  scale, origin, scale * integral, options.albedo.r, options.albedo.g,
                  options.albedo.b, options.g));
  if (!std::isfinite(scale))
    throw Error(
        fmt::format("{}: the densities are too small to choose a scale for; give one with "
                    "--density-scale",
                    options.path));

  const float azimuth = glm::radians(kSunAzimuth);
  const float elevation = glm::radians(kSunElevation);
  const glm::dvec3 backward = glm::normalize(view.origin - view.target);
  const glm::dvec3 flat = glm::normalize(glm::dvec3(backward.x, 0.0, backward.z));
  const glm::dvec3 left = glm::cross(flat, glm::dvec3(0.0, 1.0, 0.0));
  const Vec3 to_sun(double(std::cos(elevation)) *
                        (double(std::cos(azimuth)) * flat + double(std::sin(azimuth)) * left) +
                    glm::dvec3(0.0, std::sin(elevation), 0.0));
  const Daylight daylight = make_daylight(glm::normalize(to_sun), kTurbidity);
  notices.note(
      fmt::format("sun {} degrees high, {} degrees to the left of the viewer's back; "
                  "sky of a clear day",
                  kSunElevation, kSunAzimuth));

  SceneParts parts;
  parts.world_medium =
      make_heterogeneous_medium(grid, scale, std::make_shared<ConstantField>(options.albedo),
                                HenyeyGreenstein{options.g}, media_settings(options.settings));
  parts.environments = {daylight.sky, daylight.sun};

  LoadedScene loaded;
  loaded.scene = std::make_unique<const Scene>(std::move(parts));
  loaded.camera = std::make_shared<PerspectiveCamera>(PerspectiveView{
      .to_world = camera_to_world(view), .x_fov = glm::radians(kFieldOfView), .aspect = aspect});
  loaded.film = {.size = options.size,
                 .crop_size = options.size,
                 .filter = std::make_shared<GaussianFilter>()};
  loaded.path.lighting = options.settings.lighting;
  loaded.path.approximations = options.settings.approximations;
  loaded.sample_count = 64;
  loaded.files = {options.path};
  return loaded;
}

}  // namespace brume
