// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/vec.h"
#include "film/camera_sample.h"

namespace brume {

/// Layers that cost memory and are kept only on request.
struct FilmLayers {
  bool albedo = false;
  bool depth = false;
};

/// Samples that were NaN, infinite or negative. Any is a bug, so that the first is worth a look.
struct BadSamples {
  std::uint64_t count;
  std::uint32_t x, y;  // the first pixel that had one, row by row
};

/// Accumulates the samples of every pixel, in double, and knows how far the means may be off.
///
/// Consecutive samples of a pixel form replications of `Sampler::kReplication`. Samples within one
/// depend on each other, so that their spread says little about the error of their mean; whole
/// replications are independent, and the spread of their means is honest (Owen 1997). 120 bytes a
/// pixel. Different pixels may be filled by different threads, one pixel by one at a time.
class Film {
 public:
  Film(std::uint32_t width, std::uint32_t height, FilmLayers layers = {});

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  FilmLayers layers() const { return {.albedo = !albedo_.empty(), .depth = !depth_.empty()}; }

  /// Adds the next sample of pixel (x, y), in order of sample index. A bad one counts for nothing
  /// but `bad_samples`.
  void add(std::uint32_t x, std::uint32_t y, const CameraSample& sample);

  /// Number of samples in the mean.
  std::uint32_t samples(std::uint32_t x, std::uint32_t y) const { return at(x, y).samples; }
  /// Mean radiance; black without samples.
  Rgb mean(std::uint32_t x, std::uint32_t y) const;
  /// Mean opacity; 0 without samples.
  float alpha(std::uint32_t x, std::uint32_t y) const;
  /// Standard error of `mean` per channel; infinite with fewer than two samples, where nothing is
  /// known. With four whole replications it comes from the spread of their means, samples beyond
  /// them counting as independent; before that from the spread of single samples.
  Rgb standard_error(std::uint32_t x, std::uint32_t y) const;
  /// Mean albedo over all samples. Requires the layer.
  Rgb albedo(std::uint32_t x, std::uint32_t y) const;
  /// Mean depth [unit] over the samples that met something; infinite when none did. Requires the
  /// layer.
  float depth(std::uint32_t x, std::uint32_t y) const;

  /// Nothing when every sample was good.
  std::optional<BadSamples> bad_samples() const;

 private:
  struct Pixel {
    glm::dvec3 sum{0.0};                  // of the good samples
    glm::dvec3 sum_before{0.0};           // the same when the current replication began
    glm::dvec3 squares{0.0};              // of single samples' deviations from their mean
    glm::dvec3 replication_squares{0.0};  // of whole replications' deviations from their mean
    double alpha_sum = 0.0;
    std::uint32_t samples = 0;       // good ones
    std::uint32_t replications = 0;  // whole ones: all samples were good
    std::uint8_t in_replication = 0;
    bool replication_spoiled = false;
  };
  struct Depth {
    double sum = 0.0;
    std::uint32_t samples = 0;
  };

  static void close_replication(Pixel& pixel);

  std::size_t index(std::uint32_t x, std::uint32_t y) const {
    assert(x < width_ && y < height_);
    return std::size_t(y) * width_ + x;
  }
  const Pixel& at(std::uint32_t x, std::uint32_t y) const { return pixels_[index(x, y)]; }

  std::uint32_t width_, height_;
  std::vector<Pixel> pixels_;       // [height][width]
  std::vector<glm::dvec3> albedo_;  // [height][width], sums; empty when not requested
  std::vector<Depth> depth_;        // [height][width]; empty when not requested
  std::atomic<std::uint64_t> bad_count_{0};
  std::atomic<std::size_t> first_bad_{SIZE_MAX};
};

}  // namespace brume
