// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/box.h"
#include "core/vec.h"
#include "geometry/hierarchy.h"
#include "geometry/hit.h"
#include "geometry/precise.h"

namespace brume {

/// A point of a shape chosen to be seen from somewhere.
struct ShapeSample {
  Vec3 p;       // on the shape [unit]
  Vec3 n;       // unit geometric normal there, outside side
  float error;  // as `Hit::error` [unit]
  float pdf;    // solid angle seen from the reference point [1/sr]
};

/// A surface in space. The outside is the side that its geometric normal points to.
///
/// Normals, surface parameters and flip_normals are those of Mitsuba 3, except that a mirrored
/// transform keeps the outside outside: Mitsuba turns spheres, cylinders and meshes inside out.
class Shape {
 public:
  virtual ~Shape() = default;

  virtual Box3 bounds() const = 0;
  /// Surface area [unit^2].
  virtual float area() const = 0;
  /// Whether the surface separates an inside from an outside.
  virtual bool is_closed() const = 0;

  /// A point uniform over the area of the shape.
  virtual SurfacePoint sample_area(const Vec2& u) const = 0;

  /// A point as seen from `from`, by solid angle where the shape allows it and by area elsewhere;
  /// nothing when no point can be seen. Parts of the shape may hide the point.
  virtual std::optional<ShapeSample> sample_toward(const Vec3& from, const Vec2& u) const = 0;
  /// Density of `sample_toward` for the direction from `from` to `hit` on this shape [1/sr].
  virtual float pdf_toward(const Vec3& from, const Hit& hit) const = 0;

  /// First crossing of the ray for t in (0, t_max].
  virtual std::optional<Crossing> intersect(const PreciseRay& ray, double t_max) const = 0;
  /// Whether there is any, wherever it lies.
  virtual bool occludes(const PreciseRay& ray, double t_max) const {
    return intersect(ray, t_max).has_value();
  }
  /// The surface where `intersect` found it; `t` and `shape` are left to the caller.
  virtual Hit hit(const PreciseRay& ray, const Crossing& crossing) const = 0;
};

}  // namespace brume
