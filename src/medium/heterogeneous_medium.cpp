// SPDX-License-Identifier: Apache-2.0
#include "medium/heterogeneous_medium.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <concepts>
#include <type_traits>

#include "medium/majorant_check.h"
#include "medium/marched_medium.h"
#include "medium/similar_medium.h"
#include "volume/bounds_grid.h"
#include "volume/packed_grid.h"
#include "volume/voxel_blocks.h"

namespace brume {
namespace {

/// Part of the extinction that a cell has everywhere, known without a lookup. A coloured density
/// is bounded over all channels, and its collisions need each channel's value.
float control(const ValueRange& range, float /*value type*/) {
  return range.min;
}
float control(const ValueRange& /*range*/, const Rgb& /*value type*/) {
  return 0.0f;
}

/// Optical thickness that a flight passes before its next tentative collision; `u` in [0, 1).
float sample_optical_thickness(float u) {
  // u lies on the grid of 2^-24, where 1 - u is exact: the logarithm loses nothing to log1p.
  return -std::log(1.0f - u);
}

// What a tentative collision turns into under the majorant: whether it is real. Multiplies
// `weight` by value over probability. `sigma_t()` looks the extinction up, which a collision with
// the part `sigma_c` that is there anyway does not need (Kutz et al. 2017, decomposition tracking).

template <class Lookup>
bool is_real(float sigma_maj, float sigma_c, const Rgb& /*beta*/, Rgb& /*weight*/, Rng& rng,
             Lookup&& sigma_t) {
  const float u = rng.next_float() * sigma_maj;
  return u < sigma_c || u < sigma_t();
}

/// The probability averages the channels by what each still carries (Kutz et al. 2017, eq. 14).
template <class Lookup>
requires std::same_as<std::invoke_result_t<Lookup>, Rgb>
bool is_real(float sigma_maj, float /*sigma_c*/, const Rgb& beta, Rgb& weight, Rng& rng,
             Lookup&& sigma_t) {
  const Rgb carried = beta * weight;
  const float total = carried.r + carried.g + carried.b;
  const Rgb p_channel = glm::min(sigma_t() / sigma_maj, Rgb{1.0f});
  const float p = total > 0.0f ? glm::dot(carried, p_channel) / total : mean(p_channel);
  const bool real = rng.next_float() < p;
  weight *= real ? p_channel / p : (1.0f - p_channel) / (1.0f - p);
  return real;
}

/// Light scattered straight on goes on as if nothing had happened. Nothing where it depends on the
/// place or the colour how much of it there is.
std::optional<float> part_scattered_straight_on(const ColorField& albedo, HenyeyGreenstein phase) {
  const std::optional<Rgb> constant = albedo.constant();
  if (!phase.keeps_direction() || !constant || !is_grey(*constant)) return std::nullopt;
  return constant->r;
}

bool scatters_nothing(const ColorField& albedo, HenyeyGreenstein phase) {
  const std::optional<Rgb> constant = albedo.constant();
  return (constant && is_black(*constant)) || part_scattered_straight_on(albedo, phase);
}

/// Bounds of this size are in the caches, once used [bytes]; of others so many cells of a flight
/// are asked for before it begins.
constexpr std::size_t kNearMemory = std::size_t(4) << 20;
constexpr int kCellsAhead = 4;

enum class VoxelLookup { kNearest, kStochastic, kTrilinear };

template <class Value>
VoxelLookup voxel_lookup(const Grid<Value>& grid, const TrackingSettings& settings) {
  if (grid.interpolation() == Interpolation::kNearest ||
      settings.lookup == TrackingSettings::Lookup::kNearest)
    return VoxelLookup::kNearest;
  return settings.lookup == TrackingSettings::Lookup::kTrilinear ? VoxelLookup::kTrilinear
                                                                 : VoxelLookup::kStochastic;
}

/// Width of the cells of the bounds [voxels].
template <class Value>
float cell_size(const Grid<Value>& grid, const TrackingSettings& settings) {
  if (settings.bounds == TrackingSettings::Bounds::kCells) return 4.0f;
  return std::ceil(max_component(grid.box().size()));
}

/// The least step [unit] from `t` along the segment that makes way. A shorter one, in a medium
/// thick beyond measure, would never leave its place: neither points nor `t` can tell it.
class LeastStep {
 public:
  explicit LeastStep(const IndexSegment& segment)
      : of_points_(0x1p-24f * max_component(glm::abs(segment.o)) /
                   max_component(glm::abs(segment.d))) {}
  float operator()(float t) const { return std::max(of_points_, 0x1p-23f * t); }

 private:
  float of_points_;  // [unit]
};

float largest(float v) {
  return v;
}
float largest(const Rgb& v) {
  return max_component(v);
}

/// Packed voxels are read through the tree, others through a table of its blocks.
template <class Stored>
constexpr bool kHasBlocks = std::is_same_v<Stored, typename detail::Looked<Stored>::type>;

struct NoBlocks {
  template <class Grid>
  explicit NoBlocks(const Grid& /*grid*/) {}
  std::size_t memory_bytes() const { return 0; }
};

/// `Stored` is what voxels are kept as: float, Rgb, or a packed scalar.
template <class Stored>
class HeterogeneousMedium final : public Medium {
  using Value = typename detail::Looked<Stored>::type;

 public:
  HeterogeneousMedium(std::shared_ptr<const Grid<Stored>> density, float density_scale,
                      std::shared_ptr<const ColorField> albedo, HenyeyGreenstein phase,
                      const TrackingSettings& settings)
      : density_(std::move(density)),
        density_scale_(density_scale *
                       (1.0f - part_scattered_straight_on(*albedo, phase).value_or(0.0f))),
        only_absorbs_(scatters_nothing(*albedo, phase)),
        albedo_(std::move(albedo)),
        phase_(phase),
        voxels_(*density_),
        bounds_(*density_, cell_size(*density_, settings)),
        control_scale_(settings.control ? density_scale_ : 0.0f),
        lookup_(voxel_lookup(*density_, settings)),
        roulette_below_(settings.roulette ? 0.1f : 0.0f),
        very_thick_(settings.bounds == TrackingSettings::Bounds::kCells ? 1000.0f : kInfinity) {
    assert(std::isfinite(bounds_.total().max * density_scale_));
  }

  FreeFlight sample_free_flight(const Ray& ray, float t_max, const Rgb& beta,
                                Sampler& sampler) const override {
    FreeFlight flight{.t = t_max};
    if (only_absorbs_) {
      flight.weight = transmittance(ray, t_max, sampler.rng());
      return flight;
    }
    const auto segment = clip_to_grid(ray, t_max, bounds_, density_->index_from_world());
    if (!segment) return flight;

    Rng& rng = sampler.rng();
    GridLookup<Stored> lookup(*density_);
    float tau = sample_optical_thickness(sampler.next_1d());
    const LeastStep least_step(*segment);
    walk(*segment, [&](const Box3& box, const ValueRange& range, float t, float t1) {
      const float sigma_maj = range.max * density_scale_;
      if (!(sigma_maj > 0.0f)) return true;
      const float sigma_c = control(range, Value{}) * control_scale_;
      while (true) {
        const float tau_to_end = sigma_maj * (t1 - t);
        if (!(tau < tau_to_end)) {
          tau -= tau_to_end;
          return true;
        }
        t = std::min(t + std::max(tau / sigma_maj, least_step(t)), t1);
        tau = sample_optical_thickness(rng.next_float());
        const auto sigma_t = [&] { return extinction(lookup, box, *segment, t, sigma_maj, rng); };
        if (is_real(sigma_maj, sigma_c, beta, flight.weight, rng, sigma_t)) {
          flight.scattered = true;
          flight.t = segment->t_start + t;
          return false;
        }
      }
    });

    if (flight.scattered) {
      flight.weight *= albedo_->value(ray.at(flight.t));
      flight.phase = phase_;
    }
    return flight;
  }

  Rgb transmittance(const Ray& ray, float t_max, Rng& rng) const override {
    Value T(1.0f);
    const auto segment = clip_to_grid(ray, t_max, bounds_, density_->index_from_world());
    if (!segment) return Rgb(T);

    GridLookup<Stored> lookup(*density_);
    float tau = sample_optical_thickness(rng.next_float());
    const LeastStep least_step(*segment);
    walk(*segment, [&](const Box3& box, const ValueRange& range, float t, float t1) {
      if (!(range.max > 0.0f)) return true;
      // The control has a closed form; only what is above it is tracked, by ratio tracking.
      const float sigma_maj = range.max * density_scale_;
      const float sigma_c = control(range, Value{}) * control_scale_;
      if (sigma_c > 0.0f) T *= std::exp(-sigma_c * (t1 - t));
      const float residual = sigma_maj - sigma_c;
      while (survives_roulette(T, rng)) {
        const float tau_to_end = residual * (t1 - t);
        if (!(tau < tau_to_end)) {
          tau -= tau_to_end;
          return true;
        }
        t = std::min(t + std::max(tau / residual, least_step(t)), t1);
        tau = sample_optical_thickness(rng.next_float());
        const Value sigma_t = extinction(lookup, box, *segment, t, sigma_maj, rng);
        T *= glm::max((sigma_maj - sigma_t) / residual, Value(0.0f));
      }
      return false;
    });
    return Rgb(T);
  }

  void prefetch(const Ray& ray) const override {
    if (bounds_.memory_bytes() > kNearMemory)
      bounds_.prefetch(density_->index_from_world(), ray, kCellsAhead);
  }

  MediumSummary summary() const override {
    const glm::ivec3 voxels(density_->box().size() + 0.5f);
    const glm::ivec3& cells = bounds_.resolution();
    return {
        .description = fmt::format(
            "grid of {} x {} x {} voxels, extinction {:g} to {:g} per unit, bounded in {} x {} "
            "x {} cells, g {:g}",
            voxels.x, voxels.y, voxels.z, bounds_.total().min * density_scale_,
            bounds_.total().max * density_scale_, cells.x, cells.y, cells.z, phase_.g),
        .scatters = bounds_.total().max > 0.0f && !only_absorbs_,
        .is_tracked = true,
        .is_chromatic = std::is_same_v<Value, Rgb>,
        .memory_bytes = density_->memory_bytes() + voxels_.memory_bytes() + bounds_.memory_bytes()};
  }

 private:
  /// Calls `visit(box, range, t0, t1)` for each cell along the segment, in order, until it returns
  /// false. Null collisions in the empty part of a cell that is very thick elsewhere would not come
  /// to an end: such a cell is visited in parts small enough to be empty or not.
  template <class Visit>
  void walk(const IndexSegment& segment, Visit&& visit) const {
    walk_cells(bounds_, segment, [&](const glm::ivec3& cell, float t, float t1) {
      const ValueRange& range = bounds_.range(cell);
      const Box3 box = bounds_.cell_box(cell);
      const float may_be_null = (range.max - range.min) * density_scale_;
      if (!(may_be_null * (t1 - t) > very_thick_)) return visit(box, range, t, t1);
      const FineBounds<Stored> parts(*density_, box);
      const IndexSegment inside{.o = segment.o + t * segment.d,
                                .d = segment.d,
                                .t_start = segment.t_start + t,
                                .t_end = t1 - t};
      bool goes_on = true;
      walk_cells(parts, inside, [&](const glm::ivec3& part, float s, float s1) {
        goes_on = visit(parts.cell_box(part), parts.range(part), t + s, t + s1);
        return goes_on;
      });
      return goes_on;
    });
  }

  /// Extinction at t along the segment [1/unit], with the expectation of interpolation. The point
  /// is held inside its cell, whose bounds therefore hold, whatever the rounding of t.
  Value extinction(GridLookup<Stored>& lookup, const Box3& box, const IndexSegment& segment,
                   float t, [[maybe_unused]] float sigma_maj, Rng& rng) const {
    const Vec3 p = glm::clamp(segment.o + t * segment.d, box.min, box.max);
    const Value sigma_t = density_scale_ * look_up(lookup, p, rng);
    check_majorant(largest(sigma_t), sigma_maj);
    return sigma_t;
  }

  Value look_up(GridLookup<Stored>& lookup, const Vec3& p, Rng& rng) const {
    switch (lookup_) {
      case VoxelLookup::kNearest:
        return lookup.nearest(p);
      case VoxelLookup::kTrilinear:
        return lookup.trilinear(p);
      case VoxelLookup::kStochastic:
        break;
    }
    if constexpr (kHasBlocks<Stored>)
      return voxels_.stochastic(p, rng);
    else
      return lookup.stochastic(p, rng);
  }

  /// Unbiased end of an estimate that has become small; sets T to 0 when it ends.
  bool survives_roulette(Value& T, Rng& rng) const {
    const float remaining = largest(T);
    if (remaining >= roulette_below_) return true;
    if (rng.next_float() * roulette_below_ < remaining) {
      T *= roulette_below_ / remaining;
      return true;
    }
    T = Value(0.0f);
    return false;
  }

  std::shared_ptr<const Grid<Stored>> density_;
  float density_scale_;  // [1/unit] per density
  bool only_absorbs_;
  std::shared_ptr<const ColorField> albedo_;
  HenyeyGreenstein phase_;
  std::conditional_t<kHasBlocks<Stored>, VoxelBlocks<Stored>, NoBlocks> voxels_;
  BoundsGrid bounds_;
  float control_scale_;  // [1/unit] per density; 0 without a control
  VoxelLookup lookup_;
  float roulette_below_;  // transmittance; 0 without roulette
  float very_thick_;      // optical thickness from which a cell is visited in parts
};

template <class Stored>
std::shared_ptr<const Medium> make(const std::shared_ptr<const Grid<Stored>>& density,
                                   float density_scale,
                                   const std::shared_ptr<const ColorField>& albedo,
                                   HenyeyGreenstein phase, const TrackingSettings& settings) {
  if (settings.march_step > 0.0f)
    return make_marched_medium(density, density_scale, albedo, phase, settings.march_step);
  return std::make_shared<HeterogeneousMedium<Stored>>(density, density_scale, albedo, phase,
                                                       settings);
}

/// With the medium that is similar to it, where one is asked for. A grid of scalars or colours
/// times a constant cannot hold one whose extinction follows the colour or place of the albedo.
template <class Stored>
std::shared_ptr<const Medium> make_with_similar(std::shared_ptr<const Grid<Stored>> density,
                                                float density_scale,
                                                std::shared_ptr<const ColorField> albedo,
                                                HenyeyGreenstein phase,
                                                const TrackingSettings& settings) {
  auto medium = make(density, density_scale, albedo, phase, settings);
  const std::optional<Rgb> constant = albedo->constant();
  if (!settings.similar_media || !constant || !is_grey(*constant)) return medium;
  const SimilarCoefficients similar = similar_coefficients(*constant, phase.g);
  return make_similar_medium(
      std::move(medium),
      make(density, density_scale * similar.extinction_scale.r,
           std::shared_ptr<const ColorField>(std::make_shared<ConstantField>(similar.albedo)),
           HenyeyGreenstein{.g = 0.0f}, settings));
}

}  // namespace

std::shared_ptr<const Medium> make_heterogeneous_medium(std::shared_ptr<const Grid<float>> density,
                                                        float density_scale,
                                                        std::shared_ptr<const ColorField> albedo,
                                                        HenyeyGreenstein phase,
                                                        const TrackingSettings& settings) {
  switch (settings.storage) {
    case TrackingSettings::Storage::k16Bit:
      return make_with_similar(packed<Packed16>(*density), density_scale, std::move(albedo), phase,
                               settings);
    case TrackingSettings::Storage::k8Bit:
      return make_with_similar(packed<Packed8>(*density), density_scale, std::move(albedo), phase,
                               settings);
    case TrackingSettings::Storage::kFloat:
      break;
  }
  return make_with_similar(std::move(density), density_scale, std::move(albedo), phase, settings);
}

std::shared_ptr<const Medium> make_heterogeneous_medium(std::shared_ptr<const Grid<Rgb>> density,
                                                        float density_scale,
                                                        std::shared_ptr<const ColorField> albedo,
                                                        HenyeyGreenstein phase,
                                                        const TrackingSettings& settings) {
  return make_with_similar(std::move(density), density_scale, std::move(albedo), phase, settings);
}

}  // namespace brume
