// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>
#include <sstream>
#include <string>

namespace brume::test {

/// Bytes of a .vol file (Mitsuba's format, version 3, float32) in the box [0, 1]^3; `value(x, y, z,
/// channel)` of each voxel.
template <class F>
std::string vol_bytes(const glm::ivec3& n, int channels, F&& value) {
  std::string bytes = "VOL\x03";
  const auto append = [&bytes](const auto& v) {
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    bytes.append(raw, sizeof v);
  };
  append(1);  // float32
  for (int axis = 0; axis < 3; ++axis) append(n[axis]);
  append(channels);
  for (const float corner : {0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f}) append(corner);
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; ++x)
        for (int c = 0; c < channels; ++c) append(float(value(x, y, z, c)));
  return bytes;
}

/// A closed mesh that is not convex: a torus around the z axis, as a Wavefront file.
inline std::string torus_obj(double radius, double tube, int rings = 16, int sides = 10) {
  std::ostringstream text;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double phi = 2.0 * M_PI * i / rings, theta = 2.0 * M_PI * j / sides;
      const double r = radius + tube * std::cos(theta);
      text << "v " << r * std::cos(phi) << " " << r * std::sin(phi) << " " << tube * std::sin(theta)
           << "\n";
    }
  const auto vertex = [&](int i, int j) { return i % rings * sides + j % sides + 1; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j)
      text << "f " << vertex(i, j) << " " << vertex(i + 1, j) << " " << vertex(i + 1, j + 1) << " "
           << vertex(i, j + 1) << "\n";
  return text.str();
}

/// A closed tetrahedron with corners at alternate corners of the cube [-1, 1]^3, as a text .ply.
inline std::string tetrahedron_ply() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "1 1 1\n-1 -1 1\n-1 1 -1\n1 -1 -1\n"
         "3 0 1 3\n3 0 2 1\n3 0 3 2\n3 1 2 3\n";
}

/// A sensor at `origin` that looks at `target`; the box filter keeps pixels apart.
inline std::string perspective(const std::string& origin, const std::string& target, double fov_deg,
                               int size) {
  std::ostringstream text;
  text << "<sensor type=\"perspective\"><float name=\"fov\" value=\"" << fov_deg
       << "\"/><transform name=\"to_world\"><lookat origin=\"" << origin << "\" target=\"" << target
       << "\" up=\"0.1, 1, 0.2\"/></transform><film type=\"hdrfilm\"><integer name=\"width\" "
          "value=\""
       << size << "\"/><integer name=\"height\" value=\"" << size
       << "\"/><rfilter type=\"box\"/></film></sensor>";
  return text.str();
}

}  // namespace brume::test
