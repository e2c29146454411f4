// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "support/temporary_folder.h"

// Scenes of the laws, in the scene language. +Y is up; slabs lie in the xz plane around the origin.

namespace brume::test {

inline std::string text_of(const glm::dvec3& v) {
  return fmt::format("{:.17g}, {:.17g}, {:.17g}", v.x, v.y, v.z);
}

inline std::string scene_text(const std::string& body, int max_depth = -1) {
  return fmt::format(
      R"(<scene version="3.0.0"><integrator type="volpath"><integer name="max_depth" value="{}"/>)"
      R"(</integrator>{}</scene>)",
      max_depth, body);
}

/// One pixel that sees along `d` through the point `target`, from `distance` before it, with
/// parallel rays over a square `width` [unit] across.
inline std::string parallel_sensor(const glm::dvec3& target, const glm::dvec3& d, double distance,
                                   double width = 1e-3) {
  const glm::dvec3 up =
      std::abs(d.y) < 0.9 * glm::length(d) ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 origin = target - distance * glm::normalize(d);
  return fmt::format(
      R"(<sensor type="orthographic"><transform name="to_world"><scale value="{0:.17g}"/>)"
      R"(<lookat origin="{1}" target="{2}" up="{3}"/></transform>)"
      R"(<float name="near_clip" value="{4:.17g}"/><float name="far_clip" value="{5:.17g}"/>)"
      R"(<film type="hdrfilm"><integer name="width" value="1"/><integer name="height" value="1"/>)"
      R"(<rfilter type="box"/></film></sensor>)",
      0.5 * width, text_of(origin), text_of(target), text_of(up), 1e-6 * distance / width,
      1e8 * distance);
}

/// A view ray that meets a slab of thickness 1 from above at cosine `mu`.
inline std::string sensor_at_cosine(double mu) {
  const glm::dvec3 d(std::sqrt((1.0 - mu) * (1.0 + mu)), -mu, 0.0);
  return parallel_sensor({0.0, 0.5, 0.0}, d, 1.0);
}

inline std::string phase_text(double g) {
  return fmt::format(R"(<phase type="hg"><float name="g" value="{:.17g}"/></phase>)", g);
}

/// `place` tells what the medium is for: `name="interior"` of a shape, or nothing for all space.
inline std::string homogeneous_text(double sigma_t, double albedo, double g,
                                    const std::string& place = R"(name="interior")") {
  return fmt::format(R"(<medium type="homogeneous" {}><float name="sigma_t" value="{:.17g}"/>)"
                     R"(<float name="albedo" value="{:.17g}"/>{}</medium>)",
                     place, sigma_t, albedo, phase_text(g));
}

constexpr double kSlabHalfWidth = 1e4;  // of slabs of thickness 1: nothing arrives at their rims

/// A slab of thickness 1 with `contents` inside an index-matched boundary.
inline std::string slab_text(const std::string& contents,
                             const std::string& bsdf = R"(<bsdf type="null"/>)") {
  return fmt::format(
      R"(<shape type="cube"><transform name="to_world"><scale value="{0:g}, 0.5, {0:g}"/>)"
      R"(</transform>{1}{2}</shape>)",
      kSlabHalfWidth, bsdf, contents);
}

/// Radiance 1 from everywhere.
inline const std::string kUniformLight =
    R"(<emitter type="constant"><float name="radiance" value="1"/></emitter>)";

/// The same from two skies, each three times as bright on one half as on the other. Light that is
/// uneven is looked for, which an even sky leaves to the paths.
inline const std::string kUniformFromTwoSkies =
    R"(<emitter type="envmap"><string name="filename" value="half_bright.pfm"/></emitter>)"
    R"(<emitter type="envmap"><string name="filename" value="half_bright.pfm"/>)"
    R"(<transform name="to_world"><rotate x="1" angle="180"/></transform></emitter>)";

/// The picture of both.
inline void write_half_bright_sky(const TemporaryFolder& folder) {
  std::string bytes = "PF\n1 4\n-1.0\n";
  for (const float L : {0.25f, 0.25f, 0.75f, 0.75f}) {
    const float rgb[] = {L, L, L};
    bytes.append(reinterpret_cast<const char*>(rgb), sizeof rgb);
  }
  folder.write("half_bright.pfm", bytes);
}

/// Radiance (1, 0, 0) from above the horizon and (0, 1, 0) from below: seen from above, a slab
/// shows its reflectance in red and its transmittance in green.
inline const std::string kHalfLitSky =
    R"(<emitter type="envmap"><string name="filename" value="half_lit.pfm"/></emitter>)";

/// The picture of `kHalfLitSky`. It has 2^12 rows: the linear step at the horizon, one row wide,
/// moves a slab's reflectance by less than 1e-7.
inline void write_half_lit_sky(const TemporaryFolder& folder) {
  constexpr int kRows = 1 << 12;
  std::string bytes = fmt::format("PF\n1 {}\n-1.0\n", kRows);
  for (int row = 0; row < kRows; ++row) {  // from the bottom
    const bool above = row >= kRows / 2;
    const float rgb[] = {above ? 1.0f : 0.0f, above ? 0.0f : 1.0f, 0.0f};
    bytes.append(reinterpret_cast<const char*>(rgb), sizeof rgb);
  }
  folder.write("half_lit.pfm", bytes);
}

}  // namespace brume::test
