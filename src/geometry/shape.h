// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/box.h"
#include "core/vec.h"
#include "geometry/hit.h"

namespace brume {

/// A point of a shape chosen to be seen from somewhere.
struct ShapeSample {
  Vec3 p;       // on the shape [unit]
  Vec3 n;       // unit geometric normal there, outside side
  float error;  // bound on the distance from `p` to the true surface [unit]
  float pdf;    // solid angle seen from the reference point [1/sr]
};

/// Triangles or quads for Embree; `indices` in threes or fours.
struct MeshData {
  std::vector<Vec3> positions;         // [unit]
  std::vector<std::uint32_t> indices;  // three a triangle
};

class Shape {
 public:
  virtual ~Shape() = default;

  virtual Box3 bounds() const = 0;
  /// Surface area [unit^2].
  virtual float area() const = 0;
  /// Whether the surface separates an inside from an outside.
  virtual bool is_closed() const = 0;

  /// A point as seen from `from`, by solid angle where the shape allows it and by area elsewhere;
  /// nothing when no point can be seen.
  virtual std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const = 0;
  /// Density of `sample_toward` for the direction from `from` to `hit` on this shape [1/sr].
  virtual float pdf_toward(const Vec3& from, const Hit& hit) const = 0;

  // TRIANGLES OR ANALYTIC: see helper contract below.
};

}  // namespace brume
