// SPDX-License-Identifier: Apache-2.0
#include "core/distribution.h"

#include <algorithm>
#include <cassert>

namespace brume {

Distribution1d::Distribution1d(std::span<const float> weights)
    : begin_(weights.size()), guide_(weights.size()), total_(0.0) {
  assert(!weights.empty());
  for (const float weight : weights) {
    assert(weight >= 0.0f);
    total_ += weight;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double cdf = total_ > 0.0 ? sum / total_ : double(i) / double(size());
    begin_[i] = static_cast<std::uint32_t>(std::min(cdf * 0x1p32, 0x1p32 - 1.0));
    sum += weights[i];
  }
  std::uint32_t index = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    while (double(end(index)) * 0x1p-32 <= double(i) / double(size())) ++index;
    guide_[i] = index;
  }
}

float Distribution1d::probability(std::size_t index) const {
  return static_cast<float>(double(end(index) - begin_[index]) * 0x1p-32);
}

Distribution1d::Sample Distribution1d::sample(float u) const {
  // The guide leads to the interval or a few before it (Chen and Asau 1974).
  const auto target = static_cast<std::uint64_t>(u * 0x1p32f);
  std::size_t index = guide_[std::min(std::size_t(u * float(size())), size() - 1)];
  while (begin_[index] > target) --index;  // u * size was rounded up
  while (end(index) <= target) ++index;
  const double width = double(end(index) - begin_[index]);
  const double offset = double(target - begin_[index]) / width;
  const float x = static_cast<float>((double(index) + offset) / double(size()));
  return {.x = std::min(x, kOneMinusEpsilon),
          .pdf = float(width * 0x1p-32 * double(size())),
          .index = index,
          .offset = std::min(static_cast<float>(offset), kOneMinusEpsilon)};
}

float Distribution1d::pdf(float x) const {
  const auto index = std::min(std::size_t(x * float(size())), size() - 1);
  return probability(index) * float(size());
}

namespace {

std::vector<Distribution1d> make_rows(std::span<const float> weights, std::size_t width,
                                      std::size_t height) {
  assert(weights.size() == width * height);
  std::vector<Distribution1d> rows;
  rows.reserve(height);
  for (std::size_t y = 0; y < height; ++y) rows.emplace_back(weights.subspan(y * width, width));
  return rows;
}

Distribution1d make_marginal(const std::vector<Distribution1d>& rows) {
  std::vector<float> totals;
  for (const Distribution1d& row : rows) totals.push_back(static_cast<float>(row.total()));
  return Distribution1d(totals);
}

}  // namespace

Distribution2d::Distribution2d(std::span<const float> weights, std::size_t width,
                               std::size_t height)
    : rows_(make_rows(weights, width, height)), marginal_(make_marginal(rows_)) {}

Distribution2d::Sample Distribution2d::sample(const Vec2& u) const {
  const Distribution1d::Sample y = marginal_.sample(u.y);
  const Distribution1d::Sample x = rows_[y.index].sample(u.x);
  return {.xy = {x.x, y.x},
          .pdf = x.pdf * y.pdf,
          .column = x.index,
          .row = y.index,
          .offset = {x.offset, y.offset}};
}

float Distribution2d::pdf(const Vec2& xy) const {
  const auto row = std::min(std::size_t(xy.y * float(rows_.size())), rows_.size() - 1);
  return rows_[row].pdf(xy.x) * marginal_.pdf(xy.y);
}

}  // namespace brume
