// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/box.h"
#include "geometry/precise.h"

namespace brume {

/// Where a ray meets a shape, in the least data that a shape needs to say more.
struct Crossing {
  double t;            // along the ray [unit]
  std::uint32_t face;  // of the shape: which triangle, which side of the cube
  Vec2d xy;            // place on the face, in coordinates of the shape's own
};

/// What stands in the way of light, from nothing to the most.
enum class Obstacle { kNone, kPassable, kOpaque };

/// Bounding volume hierarchy: finds the items that a ray may meet. Immutable; shared between
/// threads.
///
/// Embree builds and walks it, and asks the items themselves for crossings, in double. Its own
/// triangles are tested in float: they report hits that do not exist for rays near the plane of a
/// triangle (RenderKit/embree, issue 387), and on the triangle that a ray has just left.
class Hierarchy {
 public:
  class Items {
   public:
    virtual ~Items() = default;

    /// At least 1.
    virtual std::uint32_t count() const = 0;
    virtual Box3 bounds(std::uint32_t item) const = 0;
    /// First crossing for t in (0, t_max].
    virtual std::optional<Crossing> intersect(std::uint32_t item, const PreciseRay& ray,
                                              double t_max) const = 0;
    /// What the item is to a ray of light, for t in (0, t_max].
    virtual Obstacle obstacle(std::uint32_t item, const PreciseRay& ray, double t_max) const = 0;
  };

  /// Whether to look for crossings right behind the nearest.
  enum class Behind { kIgnore, kFind };
  /// `items` must outlive the hierarchy.
  Hierarchy(const Items& items, Behind behind);
  ~Hierarchy();

  struct ItemCrossing {
    std::uint32_t item;
    Crossing crossing;
  };
  /// Crossings closer together than rounding of float coordinates can keep them, in the order of
  /// distances.
  class Cluster {
   public:
    explicit Cluster(double width) : width_(width) {}

    bool empty() const { return size_ == 0; }
    const ItemCrossing* begin() const { return crossings_.data(); }
    const ItemCrossing* end() const { return crossings_.data() + size_; }
    const ItemCrossing& nearest() const { return crossings_[0]; }
    /// No crossing beyond this distance belongs to the cluster [unit].
    double reach() const { return nearest().crossing.t + width_; }
    /// Takes a crossing up, or leaves it out as too far away. Of equally distant ones the first
    /// item comes first, so that it does not matter how the hierarchy was built.
    void add(const ItemCrossing& crossing);

   private:
    std::array<ItemCrossing, 4> crossings_;
    std::size_t size_ = 0;
    double width_;  // [unit]
  };

  struct Found {
    PreciseRay ray;     // from where the given one comes near: there, differences have more digits
    double start;       // distance of its origin from the given one [unit]
    Cluster crossings;  // along `ray`, of at least one item

    Found(const PreciseRay& r, double s, double width) : ray(r), start(s), crossings(width) {}
  };
  /// First crossing for t in (0, t_max], with those that are all but at the same place where they
  /// are looked for.
  std::optional<Found> nearest(const PreciseRay& ray, double t_max) const;
  /// The most of what stands in the way for t in (0, t_max].
  Obstacle obstacle(const PreciseRay& ray, double t_max) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace brume
