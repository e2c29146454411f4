// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/hit.h"
#include "geometry/shape.h"

namespace brume {

/// Asks all shapes of a scene at once. Immutable; shared between threads. The answer depends on
/// the shapes and the ray alone: of surfaces at the same place to within rounding the first shape
/// answers, and names the others.
class RayQueries {
 public:
  /// At least one shape, for each of which `is_passable` says whether light may go on through it
  /// (none if it is empty). `Hit::shape` is the index in `shapes`.
  explicit RayQueries(std::span<const std::shared_ptr<const Shape>> shapes,
                      std::vector<bool> is_passable = {});
  RayQueries(RayQueries&&) noexcept;
  RayQueries& operator=(RayQueries&&) noexcept;
  ~RayQueries();

  /// Nearest surface along `ray` in (0, t_max), which may be infinite. There is no smallest
  /// distance: rays that leave a surface start at `Hit::leave`.
  std::optional<Hit> intersect(const Ray& ray, float t_max) const;
  /// The most of what stands in the way along `ray` in (0, t_max).
  Obstacle obstacle(const Ray& ray, float t_max) const;

 private:
  class Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace brume
