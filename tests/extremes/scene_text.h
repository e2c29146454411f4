// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <glm/vec3.hpp>
#include <string>

namespace brume::test {

/// Pieces of the scene language. Numbers are written so that they are read back as the same
/// double.
inline std::string text(const glm::dvec3& v) {
  return fmt::format("{}, {}, {}", v.x, v.y, v.z);
}

/// As part of a name that may hold letters, digits and underscores only.
inline std::string number_name(double x) {
  std::string name = fmt::format("{:.7g}", x);
  for (char& c : name) c = c == '-' ? 'm' : c == '+' ? 'p' : c == '.' ? '_' : c;
  return name;
}

struct View {
  glm::dvec3 origin, target;
  double fov_deg = 30.0;
  double near = 1e-6, far = 1e6;  // in distances between the two points
  glm::dvec3 up{0.0, 1.0, 0.0};
};

inline std::string camera(const View& v) {
  const double distance = glm::length(v.target - v.origin);
  return fmt::format(
      R"(<sensor type="perspective"><float name="fov" value="{}"/>
<float name="near_clip" value="{}"/><float name="far_clip" value="{}"/>
<transform name="to_world"><lookat origin="{}" target="{}" up="{}"/></transform>
<film type="hdrfilm"><integer name="width" value="1"/><integer name="height" value="1"/>
<rfilter type="box"/></film></sensor>
)",
      v.fov_deg, v.near * distance, v.far * distance, text(v.origin), text(v.target), text(v.up));
}

inline std::string scene(const std::string& body, int max_depth = -1) {
  return fmt::format(
      "<scene version=\"3.0.0\">\n<integrator type=\"volpath\"><integer name=\"max_depth\" "
      "value=\"{}\"/></integrator>\n{}</scene>\n",
      max_depth, body);
}

/// `sigma_t` and `albedo` are a number or three.
inline std::string homogeneous(const std::string& sigma_t, const std::string& albedo, double g,
                               const std::string& name = "") {
  return fmt::format(
      R"(<medium {}type="homogeneous"><rgb name="sigma_t" value="{}"/>
<rgb name="albedo" value="{}"/><phase type="hg"><float name="g" value="{}"/></phase></medium>
)",
      name.empty() ? "" : fmt::format("name=\"{}\" ", name), sigma_t, albedo, g);
}
inline std::string homogeneous(double sigma_t, double albedo, double g,
                               const std::string& name = "") {
  return homogeneous(fmt::format("{}", sigma_t), fmt::format("{}", albedo), g, name);
}

/// A medium whose extinction is `volume`, an element called sigma_t.
inline std::string heterogeneous(const std::string& volume, double scale, const std::string& albedo,
                                 double g, const std::string& name = "") {
  return fmt::format(
      R"(<medium {}type="heterogeneous">{}<float name="scale" value="{}"/>
<rgb name="albedo" value="{}"/><phase type="hg"><float name="g" value="{}"/></phase></medium>
)",
      name.empty() ? "" : fmt::format("name=\"{}\" ", name), volume, scale, albedo, g);
}

/// Transform of the unit cube, or of [-1, 1]^3, to the box from `lo` to `hi`.
inline std::string from_unit_box(const glm::dvec3& lo, const glm::dvec3& hi) {
  return fmt::format(
      "<transform name=\"to_world\"><scale value=\"{}\"/><translate value=\"{}\"/></transform>",
      text(hi - lo), text(lo));
}
inline std::string from_centered_box(const glm::dvec3& lo, const glm::dvec3& hi) {
  return fmt::format(
      "<transform name=\"to_world\"><scale value=\"{}\"/><translate value=\"{}\"/></transform>",
      text(0.5 * (hi - lo)), text(0.5 * (hi + lo)));
}

inline std::string constant_volume(double value, const glm::dvec3& lo, const glm::dvec3& hi) {
  return fmt::format(
      "<volume name=\"sigma_t\" type=\"constvolume\"><float name=\"value\" "
      "value=\"{}\"/>{}</volume>",
      value, from_unit_box(lo, hi));
}
inline std::string vol_volume(const std::string& file, const glm::dvec3& lo, const glm::dvec3& hi,
                              const std::string& filter = "trilinear") {
  return fmt::format(
      "<volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" "
      "value=\"{}\"/><string "
      "name=\"filter_type\" value=\"{}\"/>{}</volume>",
      file, filter, from_unit_box(lo, hi));
}

/// `inside`: bsdf, media and emitter of the shape.
inline std::string sphere(const glm::dvec3& center, double radius, const std::string& inside) {
  return fmt::format(
      "<shape type=\"sphere\"><point name=\"center\" value=\"{}\"/><float name=\"radius\" "
      "value=\"{}\"/>{}</shape>\n",
      text(center), radius, inside);
}
inline std::string cube(const glm::dvec3& lo, const glm::dvec3& hi, const std::string& inside) {
  return fmt::format("<shape type=\"cube\">{}{}</shape>\n", from_centered_box(lo, hi), inside);
}
inline std::string environment(double radiance = 1.0) {
  return fmt::format(
      "<emitter type=\"constant\"><float name=\"radiance\" value=\"{}\"/></emitter>\n", radiance);
}
inline const std::string kNull = "<bsdf type=\"null\"/>";

}  // namespace brume::test
