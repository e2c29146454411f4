// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "film/image.h"
#include "study/accuracy.h"

namespace brume {

/// One way to render the scene that a study measures.
struct Trial {
  std::string name;                    // "lookup=nearest"
  std::string group;                   // "voxel lookup"; trials of a group stand together
  std::vector<std::string> options{};  // of `brume render` that choose it
  bool biased = false;                 // declared so
  std::optional<std::uint32_t> spp{};  // samples a pixel; chosen to fit the time otherwise
};

/// What a trial came to.
struct TrialResult {
  Trial trial;
  std::uint32_t spp;         // samples a pixel
  int seeds;                 // pictures rendered with them
  double seconds;            // of rendering one such picture, all threads at work
  std::size_t memory_bytes;  // of volume data and bounds
  Accuracy accuracy;         // of one such picture
  Image picture;             // one of them
  Image mean;                // of all

  /// Seconds times variance: what one unit of accuracy costs. Less is better.
  double cost() const { return seconds * accuracy.variance; }
};

/// What can be rendered in different ways.
class Subject {
 public:
  virtual ~Subject() = default;

  /// Sets up for `trial`, which the following calls are about.
  virtual void prepare(const Trial& trial) = 0;

  struct Rendered {
    Image picture;   // R, G and B
    double seconds;  // of processor time over the number of threads
  };
  /// A picture of `spp` samples a pixel; those of different seeds are independent.
  virtual Rendered render(std::uint32_t spp, std::uint64_t seed) = 0;

  virtual std::size_t memory_bytes() const = 0;
};

}  // namespace brume
