// SPDX-License-Identifier: Apache-2.0
#include "geometry/similarity.h"

namespace brume {

std::optional<Similarity> as_similarity(const glm::dmat4& to_world) {
  constexpr double kTolerance = 1e-6;  // a matrix in a file has six digits
  const Mat3d linear(to_world);
  const double scale = std::cbrt(std::abs(glm::determinant(linear)));
  if (!(scale > 0.0) || !std::isfinite(scale)) return std::nullopt;

  const Mat3d m = linear / scale;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(glm::length(m[i]) - 1.0) <= kTolerance)) return std::nullopt;
    if (!(std::abs(glm::dot(m[i], m[(i + 1) % 3])) <= kTolerance)) return std::nullopt;
  }

  // Orthonormal to double precision, whatever the digits of the file.
  Mat3d rotation;
  rotation[2] = glm::normalize(m[2]);
  rotation[0] = glm::normalize(m[0] - glm::dot(m[0], rotation[2]) * rotation[2]);
  rotation[1] = glm::cross(rotation[2], rotation[0]);
  if (glm::dot(rotation[1], m[1]) < 0.0) rotation[1] = -rotation[1];
  return Similarity{.offset = Vec3d(to_world[3]), .scale = scale, .rotation = rotation};
}

}  // namespace brume
