// SPDX-License-Identifier: Apache-2.0
#include "study/same_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "study/grouped_sum.h"

namespace brume {
namespace {

/// Probabilities of hypotheses that need not be independent, as one (Liu and Xie 2020, eq. 1).
class CauchyCombination {
 public:
  void add(double p) {
    // tan(pi/2 - pi p) without the cancellation at small p; p = 1 gives a finite number in double.
    sum_ += 1.0 / std::tan(M_PI * std::max(p, 1e-300));
    count_ += 1;
  }
  double p() const { return count_ == 0 ? 1.0 : std::atan2(double(count_), sum_) / M_PI; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// Blocks are large, so that their sums are nearly normal, and few, so that one that differs is
/// not lost among the others.
int block_size(int width, int height) {
  constexpr int kBlocksAcross = 12;
  constexpr int kMinSize = 8;  // [pixel]
  return std::max((std::max(width, height) + kBlocksAcross - 1) / kBlocksAcross, kMinSize);
}

}  // namespace

SamePicture test_same_picture(const Picture& a, const Picture& b) {
  assert(a.width() == b.width() && a.height() == b.height());
  assert(a.has_errors() || b.has_errors());
  const int size = block_size(a.width(), a.height());
  const int across = (a.width() + size - 1) / size;
  const int down = (a.height() + size - 1) / size;
  std::vector<GroupedSum> blocks(std::size_t(across) * std::size_t(down) * 3);
  GroupedSum whole[3];

  SamePicture result;
  double squares = 0.0;
  std::uint64_t beyond = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const glm::dvec3 difference = a.colour(x, y) - b.colour(x, y);
      const glm::dvec3 variance = a.variance(x, y) + b.variance(x, y);
      for (int c = 0; c < 3; ++c) {
        const double d = difference[c], v = variance[c];
        if (!std::isfinite(v)) {
          result.unknown += 1;
        } else if (v == 0.0) {
          result.impossible += d != 0.0;
        } else {
          result.compared += 1;
          squares += d * d / v;
          beyond += d * d > 9.0 * v;
          blocks[(std::size_t(y / size) * std::size_t(across) + std::size_t(x / size)) * 3 +
                 std::size_t(c)]
              .add(x, y, d, v);
          whole[c].add(x, y, d, v);
        }
      }
    }

  CauchyCombination combination;
  for (const GroupedSum& block : blocks)
    if (block.pixels() > 0) combination.add(block.p());
  // The whole picture weighs as much as all its blocks, or a small error everywhere would be lost.
  for (const GroupedSum& channel : whole) {
    if (channel.pixels() == 0) continue;
    const double p = channel.p();
    for (std::size_t i = 0; i < blocks.size() / 3; ++i) combination.add(p);
  }
  result.p_same = result.impossible > 0 ? 0.0 : combination.p();
  if (result.compared > 0) {
    result.mean_square_z = squares / double(result.compared);
    result.share_beyond_3 = double(beyond) / double(result.compared);
  }
  return result;
}

}  // namespace brume
