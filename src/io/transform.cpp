// SPDX-License-Identifier: Apache-2.0
#include "io/transform.h"

#include <cmath>
#include <numbers>

namespace brume {

glm::dmat4 translation(const glm::dvec3& offset) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(offset, 1.0);
  return m;
}

glm::dmat4 scaling(const glm::dvec3& factors) {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i][i] = factors[i];
  return m;
}

glm::dmat4 rotation(const glm::dvec3& axis, double angle_deg) {
  // Quarter turns are exact, so that axis-aligned things stay axis-aligned.
  const double turns = angle_deg / 90.0;
  const double angle = std::remainder(angle_deg, 360.0) * std::numbers::pi / 180.0;
  double sine = std::sin(angle), cosine = std::cos(angle);
  if (turns == std::floor(turns)) {
    sine = std::round(sine);
    cosine = std::round(cosine);
  }
  const glm::dvec3 a = glm::normalize(axis);
  // Rodrigues 1840: v cos + (a x v) sin + a (a . v)(1 - cos).
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 v(0.0);
    v[i] = 1.0;
    m[i] = glm::dvec4(v * cosine + glm::cross(a, v) * sine + a * (a[i] * (1.0 - cosine)), 0.0);
  }
  return m;
}

glm::dmat4 look_at(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up) {
  const glm::dvec3 forward = glm::normalize(target - origin);
  glm::dvec3 reference = up;
  if (up == glm::dvec3(0.0)) {
    reference[std::abs(forward.x) < 0.9 ? 0 : 1] = 1.0;
  }
  const glm::dvec3 left = glm::normalize(glm::cross(glm::normalize(reference), forward));
  return {glm::dvec4(left, 0.0), glm::dvec4(glm::cross(forward, left), 0.0),
          glm::dvec4(forward, 0.0), glm::dvec4(origin, 1.0)};
}

}  // namespace brume
