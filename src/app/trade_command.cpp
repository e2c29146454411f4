// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/commands.h"
#include "app/input.h"
#include "app/scene_subject.h"
#include "app/trade_json.h"
#include "app/trials.h"
#include "app/version.h"
#include "core/error.h"
#include "film/atomic_file.h"
#include "film/read_image.h"
#include "render/interrupt.h"
#include "render/progress.h"
#include "study/trade_report.h"

namespace brume {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void write_text(const std::string& path, const std::string& text) {
  write_file_atomically(path, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

/// The report and, beside it, the same for programs.
struct ReportPaths {
  std::string html, csv, json;

  explicit ReportPaths(const TradeOptions& options) {
    std::filesystem::path path = options.report_path;
    if (path.empty())
      path = std::filesystem::path(options.render.input).stem().string() + "_trade.html";
    if (path.extension() != ".html" && path.extension() != ".htm")
      throw Error(fmt::format("{}: a report is an .html file", path.string()));
    html = path.string();
    csv = path.replace_extension(".csv").string();
    json = path.replace_extension(".json").string();
    for (const std::string& file : {html, csv, json}) check_writable(file);
  }
};

/// What a glance at the scene tells.
struct Glance {
  double seconds_per_pixel_sample;
  double radiance;
};

Glance glance_at(const RenderOptions& options, const glm::ivec2& full_size) {
  constexpr double kWidth = 48.0;  // [pixel]
  constexpr std::uint32_t kSamples = 4;
  const double scale = std::min(kWidth / full_size.x, 1.0);
  RenderOptions small = options;
  small.size = glm::max(glm::ivec2(glm::round(scale * glm::dvec2(full_size))), glm::ivec2(1));
  SceneSubject subject(small);
  subject.prepare({.name = "default", .group = "default"});
  const Clock::time_point begin = Clock::now();
  const Image picture = subject.render(kSamples, 0).picture;
  const double samples = double(kSamples) * small.size->x * small.size->y;
  return {.seconds_per_pixel_sample = seconds_since(begin) / samples,
          .radiance = reference_of_picture(picture).radiance};
}

/// Size at which every trial has time for a thousand samples a pixel: noise hides bias sooner than
/// few pixels do.
glm::ivec2 affordable_size(const glm::ivec2& full_size, double seconds_per_pixel_sample,
                           double seconds_a_trial) {
  constexpr double kSamples = 1024.0, kMinWidth = 64.0, kMaxWidth = 256.0;
  const double pixels = seconds_a_trial / (kSamples * seconds_per_pixel_sample);
  const double full_pixels = double(full_size.x) * full_size.y;
  const double width =
      std::clamp(full_size.x * std::sqrt(pixels / full_pixels), kMinWidth, kMaxWidth);
  const double scale = std::min(width / full_size.x, 1.0);
  return glm::max(glm::ivec2(glm::round(scale * glm::dvec2(full_size))), glm::ivec2(1));
}

/// One line that says what is measured and how much time is left.
class StudyLine {
 public:
  explicit StudyLine(bool quiet)
      : style_(quiet ? ProgressStyle::kQuiet : progress_style_of(stderr)) {}
  ~StudyLine() {
    if (style_ == ProgressStyle::kBar) fmt::print(stderr, "\r\x1b[K");
  }
  StudyLine(const StudyLine&) = delete;
  StudyLine& operator=(const StudyLine&) = delete;

  void show(const StudyProgress& progress) {
    const int left = int(std::ceil(progress.seconds_left));
    const std::string words =
        fmt::format("measuring {}, {}:{:02} left", progress.activity, left / 60, left % 60);
    if (style_ == ProgressStyle::kBar)
      fmt::print(stderr, "\r\x1b[K{}", words);
    else if (style_ == ProgressStyle::kPlain && progress.activity != last_)
      fmt::print(stderr, "{}\n", words);
    std::fflush(stderr);
    last_ = progress.activity;
  }

 private:
  ProgressStyle style_;
  std::string last_;
};

/// The command line that renders the input with what was said of it.
std::string render_command(const RenderOptions& options) {
  std::string command = "brume render " + options.input;
  for (const auto& [name, value] : options.definitions)
    command += fmt::format(" -D {}={}", name, value);
  if (!options.grid.empty()) command += " --grid " + options.grid;
  if (options.density_scale) command += fmt::format(" --density-scale {}", *options.density_scale);
  if (const auto& a = options.albedo)
    command += fmt::format(" --albedo {},{},{}", a->r, a->g, a->b);
  if (options.g) command += fmt::format(" --g {}", *options.g);
  return command;
}

void write_reports(const ReportPaths& paths, const Study& study, const ReportInfo& info) {
  write_text(paths.html, html_report(study, info));
  write_text(paths.csv, csv_report(study, info));
  write_text(paths.json, trade_json(study, info));
}

}  // namespace

int run_trade(const TradeOptions& options) {
  const Clock::time_point begin = Clock::now();
  const ReportPaths paths(options);
  RenderOptions render = options.render;
  if (render.threads == 0) render.threads = int(std::max(std::thread::hardware_concurrency(), 1u));
  std::optional<Reference> reference;
  if (!options.reference_path.empty()) {
    const Image picture = read_image_with_errors(options.reference_path);
    render.size = glm::ivec2(picture.width, picture.height);
    reference = reference_of_picture(picture);
  }

  const InterruptGuard guard;
  Notices notices;
  RenderOptions own_size = render;
  own_size.size.reset();
  std::optional<LoadedScene> scene = load_input(own_size, notices);
  print_notices(notices, render.quiet);
  const glm::ivec2 full_size = scene->film.size;
  std::vector<Trial> trials = design_trials(*scene);
  scene.reset();  // every trial loads its own

  const Glance glance = glance_at(render, full_size);
  if (interrupt_requested()) return kExitInterrupted;
  if (!(glance.radiance > 0.0))
    throw Error(fmt::format("{}: its picture is black: there is nothing to measure", render.input));
  for (Trial& trial : design_clamping_trials(glance.radiance)) trials.push_back(std::move(trial));
  if (!render.size)
    render.size = affordable_size(full_size, glance.seconds_per_pixel_sample,
                                  0.6 * options.budget / double(trials.size()));

  // Reports of many pictures take a moment too.
  const double writing = 0.5 + 0.02 * options.budget;
  StudyLine line(options.render.quiet);
  SceneSubject subject(render);
  const Study study = run_study(subject, trials,
                                {.seconds = options.budget - seconds_since(begin) - writing,
                                 .reference = std::move(reference),
                                 .report = [&](const StudyProgress& p) { line.show(p); },
                                 .stops = interrupt_requested});
  if (study.results.empty()) return kExitInterrupted;
  const ReportInfo info{.input = render.input,
                        .command = render_command(render),
                        .version = kVersion,
                        .threads = render.threads,
                        .budget = options.budget,
                        .seconds = seconds_since(begin),
                        .size = *render.size,
                        .full_size = full_size};
  write_reports(paths, study, info);
  fmt::print("{}\n{}\n{}: {} settings measured in {:.0f} s\n", text_table(study, info),
             text_recommendations(study, info), paths.html, study.results.size(), info.seconds);
  return study.complete ? 0 : kExitInterrupted;
}

}  // namespace brume
