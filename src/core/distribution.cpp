// SPDX-License-Identifier: Apache-2.0
#include "core/distribution.h"

#include <algorithm>
#include <cassert>

namespace brume {

Distribution1d::Distribution1d(std::span<const float> weights) : cdf_(weights.size() + 1, 0.0) {
  assert(!weights.empty());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    assert(weights[i] >= 0.0f);
    cdf_[i + 1] = cdf_[i] + weights[i];
  }
  total_ = cdf_.back();
  for (std::size_t i = 0; i < cdf_.size(); ++i)
    cdf_[i] = total_ > 0.0 ? cdf_[i] / total_ : double(i) / double(size());
}

float Distribution1d::probability(std::size_t index) const {
  return static_cast<float>(cdf_[index + 1] - cdf_[index]);
}

Distribution1d::Sample Distribution1d::sample(float u) const {
  // The last entry that is <= u starts an interval of positive width.
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end() - 1, double(u));
  const std::size_t index = std::size_t(above - cdf_.begin()) - 1;
  const double width = cdf_[index + 1] - cdf_[index];
  const double offset = (u - cdf_[index]) / width;
  const float x = static_cast<float>((double(index) + offset) / double(size()));
  return {.x = std::min(x, kOneMinusEpsilon),
          .pdf = float(width * double(size())),
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
