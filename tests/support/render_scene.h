// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/path_integrator.h"
#include "integrator/reference_integrator.h"
#include "io/scene_file.h"
#include "medium/majorant_check.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"

namespace brume::test {

/// A scene written in the scene language, with the files it refers to, ready to render.
class TestScene {
 public:
  /// `write_files` puts what the scene refers to into the scene's folder.
  explicit TestScene(const std::string& xml,
                     const std::function<void(const TemporaryFolder&)>& write_files = {},
                     const EstimatorSettings& settings = {}) {
    if (write_files) write_files(folder_);
    Notices unheeded;
    loaded_ = load_scene(folder_.write("scene.xml", xml), {}, unheeded, std::nullopt, settings);
  }

  const LoadedScene& loaded() const { return loaded_; }
  int width() const { return loaded_.film.size.x; }
  int height() const { return loaded_.film.size.y; }

  /// Point of the film in [0, 1]^2 for a sample of pixel (x, y).
  Vec2 film_point(int x, int y, Sampler& sampler) const {
    return (Vec2(x, y) + 0.5f + loaded_.film.filter->sample(sampler.next_2d())) /
           Vec2(loaded_.film.size);
  }

 private:
  TemporaryFolder folder_;
  LoadedScene loaded_;
};

/// Channels of a rendered picture: three colours and opacity.
enum Channel { kRed, kGreen, kBlue, kOpacity, kChannelCount };

/// A picture of which every replication of `Sampler::kReplication` samples is kept apart: their
/// means are independent, so that their spread is an honest standard error.
class Rendered {
 public:
  Rendered(int width, int height, int replications)
      : width_(width),
        height_(height),
        replications_(replications),
        means_(std::size_t(width) * height * replications) {}

  int width() const { return width_; }
  int height() const { return height_; }

  /// Mean over the pixels of [x0, x1) x [y0, y1).
  RunningMean block(Channel channel, int x0, int y0, int x1, int y1) const {
    RunningMean result;
    for (int r = 0; r < replications_; ++r) {
      double sum = 0.0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += means_[index(x, y, r)][channel];
      result.add(sum / ((x1 - x0) * (y1 - y0)));
    }
    return result;
  }
  RunningMean pixel(Channel channel, int x, int y) const {
    return block(channel, x, y, x + 1, y + 1);
  }
  RunningMean whole(Channel channel) const { return block(channel, 0, 0, width_, height_); }

  void add(int x, int y, int replication, const std::array<double, kChannelCount>& sample) {
    for (int c = 0; c < kChannelCount; ++c)
      means_[index(x, y, replication)][c] += sample[c] / Sampler::kReplication;
  }

 private:
  std::size_t index(int x, int y, int replication) const {
    return (std::size_t(y) * width_ + x) * replications_ + replication;
  }

  int width_, height_, replications_;
  std::vector<std::array<double, kChannelCount>> means_;  // [y][x][replication]
};

namespace detail {
template <class SampleAt>
Rendered render_with(const TestScene& scene, int replications, std::uint64_t seed,
                     SampleAt&& sample_at) {
  Rendered result(scene.width(), scene.height(), replications);
  int bad = 0;
  for (int i = 0; i < replications * int(Sampler::kReplication); ++i)
    for (int y = 0; y < scene.height(); ++y)
      for (int x = 0; x < scene.width(); ++x) {
        Sampler sampler(seed, std::uint32_t(y * scene.width() + x), std::uint32_t(i));
        const Vec2 film = scene.film_point(x, y, sampler);
        const CameraSample s = sample_at(film, sampler);
        bad += !is_finite_and_non_negative(s.L) || !std::isfinite(s.alpha);
        result.add(x, y, i / int(Sampler::kReplication), {s.L.r, s.L.g, s.L.b, s.alpha});
      }
  EXPECT_EQ(bad, 0) << "samples are infinite, negative or not numbers";
  EXPECT_EQ(majorant_violations(), 0u);
  return result;
}
}  // namespace detail

/// Renders as the program does, with `replications` of `Sampler::kReplication` samples a pixel.
inline Rendered render_path(const TestScene& scene, int replications, std::uint64_t seed = 1) {
  const PathIntegrator integrator(*scene.loaded().scene, *scene.loaded().camera,
                                  scene.loaded().path);
  return detail::render_with(scene, replications, seed, [&](const Vec2& film, Sampler& sampler) {
    return integrator.sample(film, sampler);
  });
}

/// Renders with the slow, obvious integrator. The opacity stays 0.
inline Rendered render_reference(const TestScene& scene, int replications, std::uint64_t seed = 2) {
  const ReferenceIntegrator integrator(*scene.loaded().scene, *scene.loaded().camera,
                                       scene.loaded().path);
  return detail::render_with(scene, replications, seed, [&](const Vec2& film, Sampler& sampler) {
    return CameraSample{.L = integrator.sample(film, sampler)};
  });
}

/// The pictures agree in `channels` of every block of `size` x `size` pixels and as a whole.
inline void expect_same_picture(const Rendered& a, const Rendered& b, int size,
                                const std::vector<Channel>& channels = {kRed, kGreen, kBlue,
                                                                        kOpacity}) {
  constexpr double kRounding = 1e-6;  // of sums of floats
  for (const Channel channel : channels) {
    for (int y = 0; y < a.height(); y += size)
      for (int x = 0; x < a.width(); x += size)
        EXPECT_TRUE(agree(a.block(channel, x, y, x + size, y + size),
                          b.block(channel, x, y, x + size, y + size), kRounding))
            << "channel " << channel << ", block at (" << x << ", " << y << ")";
    EXPECT_TRUE(agree(a.whole(channel), b.whole(channel), kRounding))
        << "channel " << channel << " of the whole picture";
  }
}

}  // namespace brume::test
