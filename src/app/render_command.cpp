// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "app/attempts.h"
#include "app/camera_samples.h"
#include "app/commands.h"
#include "app/input.h"
#include "app/render_checkpoint.h"
#include "app/statistics_file.h"
#include "app/version.h"
#include "film/atomic_file.h"
#include "film/develop.h"
#include "film/write_image.h"
#include "render/interrupt.h"

namespace brume {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Outputs as asked for, or INPUT's name with .exr in the current folder.
std::vector<std::string> output_paths(const RenderOptions& options) {
  if (!options.outputs.empty()) return options.outputs;
  return {std::filesystem::path(options.input).stem().string() + ".exr"};
}

RenderSettings render_settings(const RenderOptions& options, const LoadedScene& loaded,
                               double seconds_used, std::size_t output_count) {
  RenderSettings settings;
  if (options.spp)
    settings.spp = *options.spp;
  else if (!options.seconds && !options.error)
    settings.spp = std::uint32_t(loaded.sample_count);
  settings.error = options.error.value_or(0.0);
  settings.adaptive = options.is_adaptive();
  if (options.seconds) {
    // Writing is part of the time: about half a second a megapixel and file, and more on a machine
    // with other work, as loading has shown. It is a guess, and may not take more than a tenth.
    const double megapixels = 1e-6 * loaded.film.crop_size.x * loaded.film.crop_size.y;
    const double files = double(output_count) + (options.keeps_checkpoint() ? 1.0 : 0.0);
    const double undisturbed = 0.05 + 0.5 * megapixels * files;
    const double processor_seconds = double(std::clock()) / CLOCKS_PER_SEC;
    const double slowdown = std::max(seconds_used / processor_seconds, 1.0);
    const double writing = std::clamp(slowdown * undisturbed, undisturbed,
                                      std::max(undisturbed, 0.1 * *options.seconds));
    settings.seconds = std::max(*options.seconds - seconds_used - writing, 0.0);
  }
  settings.threads = options.threads;
  settings.progress = options.quiet ? ProgressStyle::kQuiet : progress_style_of(stderr);
  return settings;
}

/// name=value, or "none".
std::string in_words(const SettingValues& settings) {
  std::string words;
  for (const auto& [name, value] : settings)
    words += fmt::format("{}{}={}", words.empty() ? "" : " ", name, value);
  return words.empty() ? "none" : words;
}

Metadata metadata(const RenderStatistics& s, const RenderOptions& options,
                  const PathSettings& path) {
  Metadata data = {
      {"Software", std::string("brume ") + kVersion},
      {"brume:scene", s.input},
      {"brume:seed", std::to_string(s.seed)},
      {"brume:samples", s.result.mean_spp},
      {"brume:seconds", s.result.state.seconds},
      {"brume:stopped", describe(s.result.reason)},
      {"brume:max_depth", path.max_depth},
      {"brume:rr_depth", path.rr_depth},
      {"brume:relative_rms_error", s.error.relative_rms},
      {"brume:relative_rms_error_bound_95", s.error.upper_bound},
      {"brume:settings", in_words(changed_settings(options.settings))},
      {"brume:biased_settings", in_words(biased_settings(options.settings))},
  };
  for (const auto& [name, value] : options.definitions)
    data.push_back({"brume:define:" + name, value});
  return data;
}

void print_summary(const RenderStatistics& s) {
  fmt::print("{} ({}x{}): {:.4g} samples a pixel in {:.1f} s, {}", fmt::join(s.outputs, ", "),
             s.size.x, s.size.y, s.result.mean_spp, s.result.state.seconds,
             describe(s.result.reason));
  if (std::isfinite(s.error.relative_rms))
    fmt::print("; relative RMS error {:.2g}%, below {:.2g}% with 95% confidence",
               100.0 * s.error.relative_rms, 100.0 * s.error.upper_bound);
  fmt::print("\n");
}

void warn_of_bad_samples(const RenderStatistics& s) {
  if (!s.bad_samples) return;
  fmt::print(stderr,
             "warning: {} samples were infinite, negative or not a number and were left out, the "
             "first in pixel ({}, {}); please report the scene\n",
             s.bad_samples->count, s.bad_samples->x, s.bad_samples->y);
}

void warn_of_darkness(const Film& film, const RenderResult& result, const LoadedScene& loaded) {
  if (loaded.scene->lights().size() == 0) return;  // which was said when it was loaded
  if (result.min_spp == 0) return;                 // nobody has looked everywhere
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x)
      if (!is_black(film.mean(x, y))) return;
  const int max_depth = loaded.path.max_depth;
  fmt::print(
      stderr,
      "warning: the picture is black: none of {:.4g} samples a pixel met light; check that no "
      "lamp is closed in or turned away and that the camera sees what they light{}\n",
      result.mean_spp,
      max_depth < 0
          ? ""
          : fmt::format(", and that max_depth, {}, leaves light enough scatterings", max_depth));
}

/// Where a picture goes that cannot be written to `output`, so that it is not lost: among the
/// temporary files or, where there is no place for them, into the current folder.
std::string rescue_path(const std::string& output) {
  const std::string stem = std::filesystem::path(output).stem();
  std::error_code ignored;
  return std::filesystem::temp_directory_path(ignored) / fmt::format("{}-{}.exr", stem, ::getpid());
}

/// The layers that were asked for, and what adaptive sampling needs: now, or in a later run.
FilmLayers film_layers(const RenderOptions& options, const LoadedScene& loaded) {
  FilmLayers layers{.guide = options.is_adaptive() || options.keeps_checkpoint()};
  for (const auto& names : {options.layers, loaded.aovs})
    for (const std::string& name : names) (name == "albedo" ? layers.albedo : layers.depth) = true;
  return layers;
}

}  // namespace

int run_render(const RenderOptions& options) {
  const Clock::time_point begin = Clock::now();
  const std::vector<std::string> outputs = output_paths(options);
  for (const std::string& output : outputs) check_output_path(output);
  if (!options.statistics_path.empty()) check_writable(options.statistics_path);
  const std::string checkpoint_path = outputs.front() + ".checkpoint";
  if (options.keeps_checkpoint()) check_writable(checkpoint_path);

  Notices notices;
  LoadedScene loaded = load_input(options, notices);
  print_notices(notices, options.quiet);
  if (options.max_depth) loaded.path.max_depth = *options.max_depth;

  Film film(std::uint32_t(loaded.film.crop_size.x), std::uint32_t(loaded.film.crop_size.y),
            film_layers(options, loaded));
  const RenderCheckpoint checkpoint(options, loaded, checkpoint_path, film);
  const PathIntegrator integrator(*loaded.scene, *loaded.camera,
                                  suited_to(loaded.film, loaded.path));

  const InterruptGuard guard;
  const double load_seconds = seconds_since(begin);
  const bool independent = options.settings.numbers == EstimatorSettings::Numbers::kIndependent;
  RenderSettings settings = render_settings(options, loaded, load_seconds, outputs.size());
  if (integrator.meets_light_paths() && !suits_adaptive_sampling(loaded.film))
    settings.adaptive = false;
  if (options.checkpoint_every) {
    settings.checkpoint_interval = *options.checkpoint_every;
    settings.save_checkpoint = [&](const RenderState& state) { checkpoint.save_or_warn(state); };
  }
  const RenderResult result =
      render(camera_samples(integrator, loaded.film, options.seed,
                            {.independent = independent, .adaptive = settings.adaptive}),
             settings, film, checkpoint.state());

  const RenderStatistics statistics{.input = options.input,
                                    .outputs = outputs,
                                    .size = loaded.film.crop_size,
                                    .seed = options.seed,
                                    .settings = options.settings,
                                    .result = result,
                                    .load_seconds = load_seconds,
                                    .error = picture_error(film),
                                    .bad_samples = film.bad_samples()};
  Attempts attempts;
  bool is_saved =
      attempts.attempt([&] { checkpoint.save(result.state); }) && options.keeps_checkpoint();
  const Image image = develop(film);
  const Metadata data = metadata(statistics, options, loaded.path);
  const ToneMapping tone_mapping{.exposure = options.exposure, .alpha = loaded.path.hide_emitters};
  for (const std::string& output : outputs)
    is_saved |= attempts.attempt([&] { write_image(output, image, data, tone_mapping); });
  if (!is_saved) {
    const std::string path = rescue_path(outputs.front());
    if (attempts.attempt([&] { write_image(path, image, data); }))
      fmt::print(stderr, "brume: what was rendered is in {}\n", path);
  }
  if (!options.statistics_path.empty())
    attempts.attempt([&] { write_statistics(options.statistics_path, statistics); });
  attempts.check();

  warn_of_bad_samples(statistics);
  warn_of_darkness(film, result, loaded);
  if (!options.quiet) print_summary(statistics);
  return result.reason == StopReason::kInterrupted ? kExitInterrupted : 0;
}

}  // namespace brume
