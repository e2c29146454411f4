// SPDX-License-Identifier: Apache-2.0
#include "render/sample_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/sampler.h"
#include "film/film.h"

namespace brume {
namespace {

constexpr int kRadius = 4;                  // [pixel] of the window that decides for a pixel
constexpr std::uint32_t kFloorDivisor = 8;  // no pixel gets less than this part of the average
constexpr std::uint32_t kFirstBlocks = 2;   // that every pixel gets
constexpr double kLargestFactor = 8.0;      // nor more than this multiple
/// Sample indices have 32 bits.
constexpr std::uint32_t kMostBlocks = 0xffffffffu / Sampler::kBlock;

/// Sums over rectangles of a picture in constant time (Crow 1984).
class SummedArea {
 public:
  template <class Value>
  SummedArea(std::uint32_t width, std::uint32_t height, const Value& value)
      : stride_(width + 1), sums_(std::size_t(stride_) * (height + 1), 0.0) {
    for (std::uint32_t y = 0; y < height; ++y) {
      double row = 0.0;
      for (std::uint32_t x = 0; x < width; ++x) {
        row += value(x, y);
        sums_[std::size_t(y + 1) * stride_ + x + 1] = sums_[std::size_t(y) * stride_ + x + 1] + row;
      }
    }
  }

  /// Over columns `left` to `right` and rows `top` to `bottom`, the ends excluded.
  double sum(std::uint32_t left, std::uint32_t top, std::uint32_t right,
             std::uint32_t bottom) const {
    return at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
  }

 private:
  double at(std::uint32_t x, std::uint32_t y) const { return sums_[std::size_t(y) * stride_ + x]; }

  std::uint32_t stride_;
  std::vector<double> sums_;  // [height + 1][width + 1]
};

/// That every pixel has after a round.
std::uint32_t fewest_blocks(std::uint32_t blocks) {
  return std::min(std::max(blocks / kFloorDivisor, kFirstBlocks), blocks);
}

/// The longest prefix that every pixel has when the round before is done.
std::size_t guide_level(std::uint32_t blocks) {
  const auto& lengths = PixelGuide::kBlocks;
  std::size_t level = 0;
  const std::uint32_t known = fewest_blocks(round_before(blocks));
  while (level + 1 < lengths.size() && lengths[level + 1] <= known) ++level;
  return level;
}

/// Standard deviation over the root of the cost, of the pixels around each but not itself.
std::vector<float> weights(const Film& film, std::size_t level) {
  const std::uint32_t width = film.width(), height = film.height();
  const auto variance_of = [&](std::uint32_t x, std::uint32_t y) {
    return double(film.guide(x, y).variance[level]);
  };
  const auto work_of = [&](std::uint32_t x, std::uint32_t y) {
    return double(film.guide(x, y).work);
  };
  const SummedArea variance(width, height, variance_of);
  const SummedArea work(width, height, work_of);
  std::vector<float> result;
  result.reserve(std::size_t(width) * height);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::uint32_t top = y - std::min<std::uint32_t>(y, kRadius);
    const std::uint32_t bottom = std::min(y + kRadius + 1, height);
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t left = x - std::min<std::uint32_t>(x, kRadius);
      const std::uint32_t right = std::min(x + kRadius + 1, width);
      // The rounding of sums may leave a little less than nothing.
      const double v = std::max(variance.sum(left, top, right, bottom) - variance_of(x, y), 0.0);
      const double c = work.sum(left, top, right, bottom) - work_of(x, y);
      result.push_back(c > 0.0 ? static_cast<float>(std::sqrt(v / c)) : 0.0f);
    }
  }
  return result;
}

}  // namespace

std::uint32_t next_round(std::uint32_t blocks) {
  return std::min(blocks + std::max(blocks / 8, 1u), kMostBlocks);
}

std::uint32_t round_before(std::uint32_t blocks) {
  std::uint32_t before = 0;
  for (std::uint32_t next = next_round(0); next < blocks; next = next_round(next)) before = next;
  return before;
}

SamplePlan even_plan(std::uint32_t blocks) {
  return {.even = blocks * Sampler::kBlock};
}

SamplePlan adaptive_plan(const Film& film, std::uint32_t blocks) {
  assert(film.layers().guide);
  if (blocks <= kFirstBlocks) return even_plan(blocks);  // nothing is known yet
  const std::vector<float> weight = weights(film, guide_level(blocks));
  double mean_weight = 0.0;
  for (const float w : weight) mean_weight += w / double(weight.size());
  if (!(mean_weight > 0.0)) return even_plan(blocks);

  const double fewest = fewest_blocks(blocks);
  const double most = std::min(kLargestFactor * double(blocks), double(kMostBlocks));
  SamplePlan plan;
  plan.uneven.reserve(weight.size());
  for (const float w : weight) {
    const double wanted = std::round(blocks * (w / mean_weight));
    plan.uneven.push_back(std::uint32_t(std::clamp(wanted, fewest, most)) * Sampler::kBlock);
  }
  return plan;
}

}  // namespace brume
