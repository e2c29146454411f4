// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

#include "core/frame.h"
#include "core/rng.h"
#include "core/vec.h"

namespace brume::test {

/// Upper regularised incomplete gamma function Q(a, x), a > 0, x >= 0: the probability that a
/// chi-square variable with 2a degrees of freedom exceeds 2x. Series below a + 1, continued
/// fraction (modified Lentz) above (Press et al. 2007, section 6.2).
inline double upper_gamma(double a, double x) {
  if (x <= 0.0) return 1.0;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (double n = a + 1.0; std::abs(term) > 1e-16 * sum; ++n) sum += term *= x / n;
    return 1.0 - scale * sum;
  }
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, h = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    c = b + an / c;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    if (std::abs(c) < kTiny) c = kTiny;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return scale * h;
}

/// A direction drawn by the sampler under test.
struct DirectionSample {
  Vec3 d;     // unit
  float pdf;  // that the sampler states for it [1/sr]
};

/// Draws a direction; nothing where the sampler finds none or the direction belongs to a Dirac.
using DirectionSampler = std::function<std::optional<DirectionSample>(Rng&)>;
/// Density of the sampler [1/sr], Dirac lobes left out. Integrates to the probability that the
/// sampler returns a direction.
using DirectionPdf = std::function<float(const Vec3&)>;

struct ChiSquareSettings {
  Vec3 axis{0.0f, 0.0f, 1.0f};  // pole of the bins, equal in solid angle
  int cosine_bins = 20;
  int azimuth_bins = 40;
  int samples = 100000;
  std::uint64_t seed = 1;
  /// Largest relative difference between the stated and the evaluated density of a sample. Sharp
  /// lobes need more, since a direction is rounded to 1e-7.
  float pdf_tolerance = 1e-3f;
  /// A thousand tests at this level all pass by chance with 99% probability (Bonferroni).
  double significance = 1e-5;
};

namespace detail {

/// A rectangle of (cos theta, azimuth) around the axis; its area is its solid angle.
struct SphereCell {
  double z0, z1, phi0, phi1;
};

/// Integrates a density over cells of the sphere by recursive Gauss-Legendre quadrature.
class CellIntegrator {
 public:
  CellIntegrator(DirectionPdf pdf, const Vec3& axis) : pdf_(std::move(pdf)), frame_(axis) {}

  /// Integral over `cell`, to well below the standard error of the share of `n` samples in it.
  double integrate(const SphereCell& cell, double n) const {
    // A first look through 16 parts, so that a lobe narrower than the cell is not overlooked.
    double estimate = 0.0;
    std::array<SphereCell, 16> parts;
    std::array<double, 16> values;
    for (int i = 0; i < 16; ++i) {
      parts[i] = part_of(cell, i % 4, i / 4, 4);
      estimate += values[i] = gauss(parts[i]);
    }
    const double tolerance = 1e-3 * std::sqrt(std::max(estimate, 1.0 / n) / n);
    double sum = 0.0;
    for (int i = 0; i < 16; ++i) sum += refine(parts[i], values[i], tolerance, 6);
    return sum;
  }

 private:
  static SphereCell part_of(const SphereCell& c, int i, int j, int n) {
    const double dz = (c.z1 - c.z0) / n, dphi = (c.phi1 - c.phi0) / n;
    return {c.z0 + i * dz, c.z0 + (i + 1) * dz, c.phi0 + j * dphi, c.phi0 + (j + 1) * dphi};
  }

  double refine(const SphereCell& cell, double coarse, double tolerance, int depth) const {
    std::array<SphereCell, 4> parts;
    std::array<double, 4> values;
    double fine = 0.0;
    for (int i = 0; i < 4; ++i) {
      parts[i] = part_of(cell, i % 2, i / 2, 2);
      fine += values[i] = gauss(parts[i]);
    }
    if (depth == 0 || std::abs(fine - coarse) <= tolerance) return fine;
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += refine(parts[i], values[i], 0.5 * tolerance, depth - 1);
    return sum;
  }

  /// Three points each way.
  double gauss(const SphereCell& c) const {
    static constexpr std::array<double, 3> kNode{-0.7745966692414834, 0.0, 0.7745966692414834};
    static constexpr std::array<double, 3> kWeight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const double dz = c.z1 - c.z0, dphi = c.phi1 - c.phi0;
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double z = c.z0 + 0.5 * dz * (1.0 + kNode[i]);
      const double r = std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)));
      for (int j = 0; j < 3; ++j) {
        const double phi = c.phi0 + 0.5 * dphi * (1.0 + kNode[j]);
        const Vec3 local(r * std::cos(phi), r * std::sin(phi), z);
        sum += kWeight[i] * kWeight[j] * double(pdf_(frame_.to_world(local)));
      }
    }
    return sum * dz * dphi;
  }

  DirectionPdf pdf_;
  Frame frame_;
};

}  // namespace detail

/// Pearson's chi-square test that `sample` draws directions with the density `pdf`, with the two
/// checks that belong to it: the density of each sample is the one stated, and the density does
/// not integrate to more than 1. Samples that find nothing are a bin of their own, so that the
/// probability of finding a direction is tested too.
inline ::testing::AssertionResult samples_follow_pdf(const DirectionSampler& sample,
                                                     const DirectionPdf& pdf,
                                                     const ChiSquareSettings& settings = {}) {
  struct Bin {
    detail::SphereCell cell;
    double observed, expected;
  };
  const int columns = settings.azimuth_bins, rows = settings.cosine_bins;
  const double n = settings.samples;

  // Expected counts.
  std::vector<Bin> bins;
  bins.reserve(std::size_t(rows) * std::size_t(columns) + 1);
  const detail::CellIntegrator integrator(pdf, settings.axis);
  double total = 0.0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const detail::SphereCell cell{.z0 = -1.0 + 2.0 * row / rows,
                                    .z1 = -1.0 + 2.0 * (row + 1) / rows,
                                    .phi0 = 2.0 * M_PI * column / columns,
                                    .phi1 = 2.0 * M_PI * (column + 1) / columns};
      const double p = integrator.integrate(cell, n);
      if (!(p >= 0.0) || !std::isfinite(p)) {
        return ::testing::AssertionFailure()
               << "density integrates to " << p << " over cos [" << cell.z0 << ", " << cell.z1
               << "], azimuth [" << cell.phi0 << ", " << cell.phi1 << "]";
      }
      total += p;
      bins.push_back({.cell = cell, .observed = 0.0, .expected = n * p});
    }
  }
  if (total > 1.001) {
    return ::testing::AssertionFailure() << "density integrates to " << total << " > 1";
  }
  bins.push_back({.cell = {}, .observed = 0.0, .expected = n * std::max(0.0, 1.0 - total)});

  // Observed counts.
  Rng rng(settings.seed);
  const Frame frame(settings.axis);
  int outside_support = 0;
  for (int i = 0; i < settings.samples; ++i) {
    const std::optional<DirectionSample> s = sample(rng);
    if (!s) {
      bins.back().observed += 1.0;
      continue;
    }
    const float evaluated = pdf(s->d);
    if (evaluated == 0.0f) {
      ++outside_support;
    } else if (!(std::abs(s->pdf - evaluated) <= settings.pdf_tolerance * evaluated)) {
      return ::testing::AssertionFailure()
             << "sample " << i << " (" << s->d.x << ", " << s->d.y << ", " << s->d.z
             << ") states the density " << s->pdf << " where " << evaluated << " is evaluated";
    }
    const Vec3 local = frame.to_local(s->d);
    double phi = std::atan2(double(local.y), double(local.x));
    if (phi < 0.0) phi += 2.0 * M_PI;
    const int row = std::clamp(int((local.z + 1.0) * 0.5 * rows), 0, rows - 1);
    const int column = std::clamp(int(phi / (2.0 * M_PI) * columns), 0, columns - 1);
    bins[std::size_t(row) * std::size_t(columns) + std::size_t(column)].observed += 1.0;
  }
  // Rounding may carry a sample across the edge of the support, but rarely.
  if (outside_support > 1e-4 * n) {
    return ::testing::AssertionFailure()
           << outside_support << " of " << settings.samples << " samples have density 0";
  }

  // Bins with few expected samples are pooled, the poorest first, until five are expected.
  std::sort(bins.begin(), bins.end(),
            [](const Bin& a, const Bin& b) { return a.expected < b.expected; });
  double chi_square = 0.0;
  int terms = 0;
  Bin worst{}, pool{};
  double worst_term = -1.0;
  for (const Bin& bin : bins) {
    pool = {.cell = bin.cell,
            .observed = pool.observed + bin.observed,
            .expected = pool.expected + bin.expected};
    if (pool.expected < 5.0) continue;
    const double difference = pool.observed - pool.expected;
    const double term = difference * difference / pool.expected;
    if (term > worst_term) {
      worst = pool;
      worst_term = term;
    }
    chi_square += term;
    ++terms;
    pool = {};
  }
  if (terms < 2) {
    // A single bin holds everything: nothing is left to compare.
    return terms == 1 ? ::testing::AssertionSuccess()
                      : ::testing::AssertionFailure() << "no bin expects five samples";
  }

  const double p_value = upper_gamma(0.5 * (terms - 1), 0.5 * chi_square);
  if (p_value >= settings.significance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "chi-square " << chi_square << " with " << terms - 1 << " degrees of freedom, p-value "
         << p_value << "; density integrates to " << total << "; the worst bin has "
         << worst.observed << " samples where " << worst.expected << " are expected, cos ["
         << worst.cell.z0 << ", " << worst.cell.z1 << "], azimuth [" << worst.cell.phi0 << ", "
         << worst.cell.phi1 << "]";
}

}  // namespace brume::test
