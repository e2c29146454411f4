// SPDX-License-Identifier: Apache-2.0
#include "study/trade_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "core/sampler.h"

namespace brume {
namespace {

constexpr int kMinSeeds = 2, kSeeds = 6;
constexpr double kReferenceShare = 1.0 / 3.0;  // of the time
/// The reference's seeds are no trial's.
constexpr std::uint64_t kReferenceSeed = 1'000'000'007;

std::uint32_t whole_blocks(double spp) {
  constexpr double kMost = 1 << 24;
  const double blocks = std::floor(std::clamp(spp, 0.0, kMost) / Sampler::kBlock);
  return Sampler::kBlock * std::uint32_t(std::max(blocks, 1.0));
}

Image mean_of(const std::vector<Image>& pictures) {
  Image mean = pictures.front();
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    double sum = 0.0;
    for (const Image& picture : pictures) sum += picture.pixels[i];
    mean.pixels[i] = float(sum / double(pictures.size()));
  }
  return mean;
}

class Runner {
 public:
  Runner(Subject& subject, const StudySettings& settings)
      : subject_(subject), settings_(settings) {}

  Study run(const std::vector<Trial>& trials) {
    report("reference");
    subject_.prepare(trials.front());
    Study study;
    if (settings_.reference)
      study.reference = *settings_.reference;
    else if (!render_reference(study))
      return study;
    for (std::size_t i = 0; i < trials.size() && !stopped(); ++i) {
      report(trials[i].name);
      measure(trials[i], seconds_left() / double(trials.size() - i), study);
    }
    study.complete = study.results.size() + study.skipped.size() == trials.size();
    return study;
  }

 private:
  double seconds_left() const {
    return settings_.seconds -
           std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  bool stopped() const { return settings_.stops && settings_.stops(); }
  void report(const std::string& activity) const {
    if (settings_.report) settings_.report({activity, std::max(seconds_left(), 0.0)});
  }

  /// Seconds of the clock that a sample of every pixel takes; grows the picture until it can be
  /// told. The clock counts against the budget, whatever else the machine does.
  double seconds_per_sample(double at_most) {
    for (std::uint32_t spp = 1;; spp *= 4) {
      const double before = seconds_left();
      subject_.render(spp, 0);
      const double seconds = before - seconds_left();
      if (spp >= Sampler::kBlock || seconds > 0.05 * at_most) return seconds / spp;
    }
  }

  /// Returns false when the study was stopped.
  bool render_reference(Study& study) {
    const double share = kReferenceShare * seconds_left();
    const double until = seconds_left() - share;
    const double each = seconds_per_sample(share);
    const std::uint32_t spp = whole_blocks(0.5 * (seconds_left() - until) / each);
    Image first = subject_.render(spp, kReferenceSeed).picture;
    Image second = subject_.render(spp, kReferenceSeed + 1).picture;
    if (stopped()) return false;
    study.reference = reference_of_halves(std::move(first), std::move(second));
    study.reference_spp = spp;
    if (!(study.reference.radiance > 0.0))
      throw Error("the picture is black: there is nothing to measure");
    return true;
  }

  void measure(const Trial& trial, double share, Study& study) {
    const double until = seconds_left() - share;
    subject_.prepare(trial);
    const double each = seconds_per_sample(share);
    const double time = seconds_left() - until;
    const std::uint32_t spp = trial.spp.value_or(whole_blocks(time / (kSeeds * each)));
    // Everything is compared with the default, whatever it takes.
    const bool is_default = study.results.empty() && study.skipped.empty();
    const double fitting = std::min(time / (spp * each), double(kSeeds));
    const int seeds = std::max(int(fitting), is_default ? kMinSeeds : 0);
    if (seeds < kMinSeeds) {
      study.skipped.push_back(
          fmt::format("{}: {} pictures of {} samples a pixel take {:.1f} s, and {:.1f} s were left "
                      "for it",
                      trial.name, kMinSeeds, spp, kMinSeeds * spp * each, std::max(time, 0.0)));
      return;
    }
    std::vector<Image> pictures;
    double seconds = 0.0;
    for (int seed = 1; seed <= seeds; ++seed) {
      // A machine that has become slower takes fewer pictures, not more time.
      if (seed > kMinSeeds && seconds_left() - until < 0.5 * spp * each) break;
      Subject::Rendered rendered = subject_.render(spp, std::uint64_t(seed));
      if (stopped()) return;  // the picture may be unfinished
      pictures.push_back(std::move(rendered.picture));
      seconds += rendered.seconds;
      report(trial.name);
    }
    study.results.push_back({.trial = trial,
                             .spp = spp,
                             .seeds = int(pictures.size()),
                             .seconds = seconds / double(pictures.size()),
                             .memory_bytes = subject_.memory_bytes(),
                             .accuracy = measure_accuracy(pictures, study.reference),
                             .picture = pictures.front(),
                             .mean = mean_of(pictures)});
  }

  Subject& subject_;
  const StudySettings& settings_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

Study run_study(Subject& subject, const std::vector<Trial>& trials, const StudySettings& settings) {
  assert(!trials.empty());
  return Runner(subject, settings).run(trials);
}

}  // namespace brume
