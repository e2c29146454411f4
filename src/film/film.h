// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/vec.h"
#include "film/camera_sample.h"

namespace brume {

/// Layers that cost memory and are kept only on request.
struct FilmLayers {
  bool albedo = false;
  bool depth = false;
  bool guide = false;  // what adaptive sampling is steered by; in no picture file
};

/// How noisy and how costly a pixel is. Each figure comes from a number of samples that was fixed
/// beforehand, however many the pixel got in the end, so that what it steers cannot depend on what
/// it steered before.
struct PixelGuide {
  /// Blocks of samples after which `variance` was taken.
  static constexpr std::array<std::uint32_t, 8> kBlocks{2, 4, 8, 16, 32, 64, 128, 256};

  /// Of the mean of so many blocks, times their samples, summed over channels: less than that of
  /// one sample where samples stratify each other.
  std::array<float, kBlocks.size()> variance{};
  float work = 0.0f;  // of one sample, over the first block; as in CameraSample
};

/// Samples that were NaN, infinite or negative. Any is a bug, so that the first is worth a look.
struct BadSamples {
  std::uint64_t count;
  std::uint32_t x, y;  // the first pixel that had one, row by row
};

/// Accumulates the samples of every pixel, in double, and knows how far the means may be off.
///
/// Samples of one replication of the `Sampler` depend on each other, so that their spread says
/// little about the error of their mean; whole replications are independent, and the spread of
/// their means is honest (Owen 1997). While they are few, the blocks that they consist of are taken
/// for independent. Those stratify each other, too, which makes the error look larger than it is.
/// 176 bytes a pixel. Different pixels may be filled by different threads, one pixel by one at a
/// time.
class Film {
 public:
  Film(std::uint32_t width, std::uint32_t height, FilmLayers layers = {});

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  FilmLayers layers() const {
    return {.albedo = !albedo_.empty(), .depth = !depth_.empty(), .guide = !guide_.empty()};
  }

  /// Adds the next sample of pixel (x, y), in order of sample index. A bad one counts for nothing
  /// but `bad_samples`.
  void add(std::uint32_t x, std::uint32_t y, const CameraSample& sample);

  /// Number of samples added, bad ones too: the index of the next.
  std::uint32_t drawn(std::uint32_t x, std::uint32_t y) const { return at(x, y).drawn; }
  /// Number of samples in the mean.
  std::uint32_t samples(std::uint32_t x, std::uint32_t y) const { return at(x, y).samples; }
  /// Mean radiance; black without samples.
  Rgb mean(std::uint32_t x, std::uint32_t y) const;
  /// Mean opacity; 0 without samples.
  float alpha(std::uint32_t x, std::uint32_t y) const;
  /// Standard error of `mean` per channel; infinite with fewer than two samples, where nothing is
  /// known. With eight whole replications it comes from the spread of their means, before that with
  /// four whole blocks from that of the blocks' means; blocks, and single samples, beyond them
  /// count as independent. With less than four blocks from the spread of single samples.
  Rgb standard_error(std::uint32_t x, std::uint32_t y) const;
  /// Mean albedo over all samples. Requires the layer.
  Rgb albedo(std::uint32_t x, std::uint32_t y) const;
  /// Mean depth [unit] over the samples that met something; infinite when none did. Requires the
  /// layer.
  float depth(std::uint32_t x, std::uint32_t y) const;

  /// What steers adaptive sampling; zero until the pixel has the blocks. Requires the layer.
  const PixelGuide& guide(std::uint32_t x, std::uint32_t y) const { return guide_[index(x, y)]; }

  /// Nothing when every sample was good.
  std::optional<BadSamples> bad_samples() const;
  /// Puts the count of bad samples to what another film of this size had.
  void set_bad_samples(const std::optional<BadSamples>& bad);

  /// All that the pixels hold, as memory: another film of the same size and layers that is given
  /// these bytes goes on as this one would. Bad samples' count is apart.
  std::vector<std::span<unsigned char>> pixel_bytes();

 private:
  /// How the means of consecutive groups of samples spread. A group with a bad sample is left out.
  struct Groups {
    glm::dvec3 sum_before{0.0};  // of the pixel, when the current group began
    glm::dvec3 squares{0.0};     // of the means' deviations from their mean
    std::uint32_t count = 0;
    std::uint32_t spoiled = 0;  // by this many bad samples in the current group
  };
  struct Pixel {
    glm::dvec3 sum{0.0};      // of the good samples
    glm::dvec3 squares{0.0};  // of their deviations from their mean
    Groups blocks, replications;
    double alpha_sum = 0.0;
    std::uint32_t samples = 0;  // good ones
    std::uint32_t drawn = 0;    // bad ones too
  };
  struct Depth {
    double sum = 0.0;
    std::uint64_t samples = 0;
  };

  static void close(Groups& groups, std::uint32_t size, const Pixel& pixel);
  /// From the spread of blocks' means if there are `least_blocks`.
  static glm::dvec3 squared_standard_error(const Pixel& pixel, std::uint32_t least_blocks);
  static void note(const Pixel& pixel, PixelGuide& guide);

  std::size_t index(std::uint32_t x, std::uint32_t y) const {
    assert(x < width_ && y < height_);
    return std::size_t(y) * width_ + x;
  }
  const Pixel& at(std::uint32_t x, std::uint32_t y) const { return pixels_[index(x, y)]; }

  std::uint32_t width_, height_;
  std::vector<Pixel> pixels_;       // [height][width]
  std::vector<glm::dvec3> albedo_;  // [height][width], sums; empty when not requested
  std::vector<Depth> depth_;        // [height][width]; empty when not requested
  std::vector<PixelGuide> guide_;   // [height][width]; empty when not requested
  std::atomic<std::uint64_t> bad_count_{0};
  std::atomic<std::size_t> first_bad_{SIZE_MAX};
};

}  // namespace brume
