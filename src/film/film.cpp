// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <algorithm>
#include <type_traits>

#include "core/sampler.h"

namespace brume {
namespace {

/// Fewer say too little about their own spread. Replications may wait for more of them, as blocks
/// serve until then.
constexpr std::uint32_t kMinBlocks = 4, kMinReplications = 8;

/// A chromatic estimate of opacity may lie outside [0, 1]; only its mean may not.
bool is_good(const CameraSample& sample) {
  return is_finite_and_non_negative(sample.L) && std::isfinite(sample.alpha) &&
         is_finite_and_non_negative(sample.albedo) && sample.depth >= 0.0f;
}

template <class T>
void append_bytes(std::vector<T>& from, std::vector<std::span<unsigned char>>& to) {
  static_assert(std::is_trivially_copyable_v<T>);
  to.emplace_back(reinterpret_cast<unsigned char*>(from.data()), from.size() * sizeof(T));
}

void lower_to(std::atomic<std::size_t>& value, std::size_t candidate) {
  std::size_t current = value.load(std::memory_order_relaxed);
  while (candidate < current &&
         !value.compare_exchange_weak(current, candidate, std::memory_order_relaxed)) {
  }
}

}  // namespace

Film::Film(std::uint32_t width, std::uint32_t height, FilmLayers layers)
    : width_(width), height_(height), pixels_(std::size_t(width) * height) {
  if (layers.albedo) albedo_.assign(pixels_.size(), glm::dvec3(0.0));
  if (layers.depth) depth_.resize(pixels_.size());
  if (layers.guide) guide_.resize(pixels_.size());
}

void Film::add(std::uint32_t x, std::uint32_t y, const CameraSample& sample) {
  const std::size_t i = index(x, y);
  Pixel& pixel = pixels_[i];
  if (is_good(sample)) {
    // Welford 1962: no cancellation, however small the spread is beside the mean.
    const glm::dvec3 L(sample.L);
    const double n = pixel.samples;
    if (pixel.samples > 0) {
      const glm::dvec3 deviation = L - pixel.sum / n;
      pixel.squares += deviation * deviation * (n / (n + 1.0));
    }
    pixel.sum += L;
    pixel.alpha_sum += sample.alpha;
    pixel.samples += 1;
    if (!albedo_.empty()) albedo_[i] += glm::dvec3(sample.albedo);
    if (!depth_.empty() && sample.depth < kInfinity) {
      depth_[i].sum += sample.depth;
      depth_[i].samples += 1;
    }
  } else {
    bad_count_.fetch_add(1, std::memory_order_relaxed);
    lower_to(first_bad_, i);
    pixel.blocks.spoiled += 1;
    pixel.replications.spoiled += 1;
  }
  if (!guide_.empty() && pixel.drawn < Sampler::kBlock)
    guide_[i].work += sample.work / float(Sampler::kBlock);
  pixel.drawn += 1;
  if (pixel.drawn % Sampler::kBlock != 0) return;
  close(pixel.blocks, Sampler::kBlock, pixel);
  if (pixel.drawn % Sampler::kReplication == 0)
    close(pixel.replications, Sampler::kReplication, pixel);
  if (!guide_.empty()) note(pixel, guide_[i]);
}

void Film::note(const Pixel& pixel, PixelGuide& guide) {
  const auto& lengths = PixelGuide::kBlocks;
  const auto found = std::find(lengths.begin(), lengths.end(), pixel.drawn / Sampler::kBlock);
  if (found == lengths.end() || pixel.samples < 2) return;
  // Two blocks say little, but those of all pixels around do.
  const glm::dvec3 variance = squared_standard_error(pixel, 2) * double(pixel.samples);
  guide.variance[std::size_t(found - lengths.begin())] =
      static_cast<float>(variance.r + variance.g + variance.b);
}

void Film::close(Groups& groups, std::uint32_t size, const Pixel& pixel) {
  if (groups.spoiled == 0) {
    const double n = groups.count;
    if (groups.count > 0) {
      const glm::dvec3 mean_before = groups.sum_before / double(pixel.samples - size);
      const glm::dvec3 mean = (pixel.sum - groups.sum_before) / double(size);
      const glm::dvec3 deviation = mean - mean_before;
      groups.squares += deviation * deviation * (n / (n + 1.0));
    }
    groups.count += 1;
  }
  groups.sum_before = pixel.sum;
  groups.spoiled = 0;
}

Rgb Film::mean(std::uint32_t x, std::uint32_t y) const {
  const Pixel& pixel = at(x, y);
  return pixel.samples == 0 ? Rgb{0.0f} : Rgb(pixel.sum / double(pixel.samples));
}

float Film::alpha(std::uint32_t x, std::uint32_t y) const {
  const Pixel& pixel = at(x, y);
  return pixel.samples == 0 ? 0.0f : static_cast<float>(pixel.alpha_sum / pixel.samples);
}

Rgb Film::standard_error(std::uint32_t x, std::uint32_t y) const {
  const Pixel& pixel = at(x, y);
  if (pixel.samples < 2) return Rgb{kInfinity};
  return Rgb(glm::sqrt(squared_standard_error(pixel, kMinBlocks)));
}

glm::dvec3 Film::squared_standard_error(const Pixel& pixel, std::uint32_t least_blocks) {
  // Variances of independent sums add: those of whole replications, of blocks beyond them, and of
  // samples beyond these.
  const auto variance_of_sum = [](const Groups& groups, double size, double count) {
    return groups.squares / (groups.count - 1.0) * (size * size * count);
  };
  constexpr double kBlock = Sampler::kBlock, kReplication = Sampler::kReplication;
  const double replications =
      pixel.replications.count < kMinReplications ? 0.0 : pixel.replications.count;
  const double blocks = pixel.blocks.count < least_blocks
                            ? 0.0
                            : pixel.blocks.count - replications * (kReplication / kBlock);
  const double n = pixel.samples;
  const double loose = n - kReplication * replications - kBlock * blocks;
  glm::dvec3 sum = pixel.squares / (n - 1.0) * loose;
  if (blocks > 0.0) sum += variance_of_sum(pixel.blocks, kBlock, blocks);
  if (replications > 0.0) sum += variance_of_sum(pixel.replications, kReplication, replications);
  return sum / (n * n);
}

Rgb Film::albedo(std::uint32_t x, std::uint32_t y) const {
  const Pixel& pixel = at(x, y);
  return pixel.samples == 0 ? Rgb{0.0f} : Rgb(albedo_[index(x, y)] / double(pixel.samples));
}

float Film::depth(std::uint32_t x, std::uint32_t y) const {
  const Depth& depth = depth_[index(x, y)];
  return depth.samples == 0 ? kInfinity : static_cast<float>(depth.sum / double(depth.samples));
}

std::optional<BadSamples> Film::bad_samples() const {
  if (bad_count_ == 0) return std::nullopt;
  return BadSamples{.count = bad_count_,
                    .x = static_cast<std::uint32_t>(first_bad_ % width_),
                    .y = static_cast<std::uint32_t>(first_bad_ / width_)};
}

void Film::set_bad_samples(const std::optional<BadSamples>& bad) {
  bad_count_ = bad ? bad->count : 0;
  first_bad_ = bad ? index(bad->x, bad->y) : SIZE_MAX;
}

std::vector<std::span<unsigned char>> Film::pixel_bytes() {
  std::vector<std::span<unsigned char>> bytes;
  append_bytes(pixels_, bytes);
  append_bytes(albedo_, bytes);
  append_bytes(depth_, bytes);
  append_bytes(guide_, bytes);
  return bytes;
}

}  // namespace brume
