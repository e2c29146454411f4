// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "integrator/light_path_guide.h"
#include "integrator/light_path_set.h"
#include "integrator/light_tracer.h"

namespace brume {

/// Light paths that paths from the camera may be connected to.
///
/// Light that scatters at a place x and then at y, the camera's side of it, may be found in two
/// ways: y is connected to a light path that ends at x, or the path from the camera goes on from y
/// and happens to come to x. The first is better where many light paths are about for the one path
/// that would come from y, and the second close to y: so each gets a share of that light,
/// `camera_share` and the rest. Shares that add up to one and depend on the path alone leave the
/// expectation as it is; these are those of the balance heuristic (Veach 1997, eq. 9.8) with the
/// density of light paths taken for the same everywhere. Near x both inverse squares cancel, as in
/// Kollig and Keller 2006.
class LightPaths {
 public:
  /// Pixels in as many groups may have light paths of their own at the same time.
  static constexpr std::uint32_t kGroups = 324;

  /// The arguments must outlive this.
  LightPaths(const Scene& scene, const Camera& camera, const CameraMedium& camera_medium,
             int max_scatterings);

  /// Whether the scene's light can be followed from the lamps, and is worth it.
  bool exist() const { return paths_per_bundle_ > 0; }

  /// What samples have in common that share light paths: any two keys have different ones.
  struct Key {
    std::uint64_t seed = 0;
    std::uint32_t group = 0;  // below kGroups
  };
  /// Those for the samples of a block: a bundle for each. May be called by many threads; costs
  /// little where those of one seed are asked for before those of the next. Precondition: exist().
  std::shared_ptr<const LightPathSet> of(const Key& shared) const;

  /// Share of the light from a place at `distance` [unit] that is left to the path from the camera,
  /// which goes on into its direction with density `pdf` [1/sr].
  float camera_share(float distance, float pdf) const {
    const float far = reach_ * distance;
    return pdf / (pdf + far * far);
  }
  /// The rest over the squared distance, finite however near the place is [reach_squared()].
  float light_share(float distance, float pdf) const {
    const float far = reach_ * distance;
    return 1.0f / (pdf + far * far);
  }
  /// Fluence of a bundle over the power of a path [1/unit^2].
  float reach_squared() const { return reach_ * reach_; }

 private:
  std::shared_ptr<const LightPathSet> traced(std::uint64_t seed) const;

  struct Slot {
    std::mutex mutex;
    std::uint64_t seed = 0;
    std::shared_ptr<const LightPathSet> set;
  };

  const Scene& scene_;
  LightTracer tracer_;
  std::optional<LightPathGuide> guide_;  // nothing where no light can be followed
  int paths_per_bundle_ = 0;
  float p_kept_ = 1.0f;  // besides the guide's
  float reach_ = 0.0f;   // [1/unit]
  mutable std::array<Slot, kGroups> slots_;
};

}  // namespace brume
