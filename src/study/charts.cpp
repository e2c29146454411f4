// SPDX-License-Identifier: Apache-2.0
#include "study/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "film/srgb.h"
#include "study/colour_scale.h"
#include "study/heat_map.h"
#include "study/log_axis.h"
#include "study/recommendation.h"
#include "study/report_text.h"

namespace brume {
namespace {

// Told apart by lightness and shape as well as by colour.
constexpr const char* kInk = "#1a1a1a";
constexpr const char* kGrid = "#dddddd";
constexpr const char* kUnbiased = "#0b5394";
constexpr const char* kBiased = "#d9822b";

/// Times that people know, about three to a power of ten.
constexpr std::pair<double, const char*> kTimeTicks[] = {
    {1e-3, "1 ms"},    {1e-2, "10 ms"},    {1e-1, "0.1 s"},      {1.0, "1 s"},
    {10.0, "10 s"},    {60.0, "1 min"},    {600.0, "10 min"},    {3600.0, "1 h"},
    {36000.0, "10 h"}, {86400.0, "1 day"}, {864000.0, "10 days"}};

constexpr double kWidth = 960.0;  // of the picture, in its own units
constexpr double kLowestError = 1e-5, kHighestError = 10.0;

std::string line(double x1, double y1, double x2, double y2, const char* colour, double width) {
  return fmt::format(
      R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="{}"/>)",
      x1, y1, x2, y2, colour, width);
}

std::string text(double x, double y, const char* anchor, const std::string& words,
                 const char* colour = kInk) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" fill="{}">{}</text>)", x, y,
                     anchor, colour, escaped(words));
}

/// The number of a trial in a circle, or in a square where it is biased.
std::string marker(double x, double y, std::size_t number, bool biased) {
  const std::string shape =
      biased ? fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="19" height="19" fill="#fff" )"
                           R"(stroke="{}" stroke-width="2"/>)",
                           x - 9.5, y - 9.5, kBiased)
             : fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="10" fill="#fff" stroke="{}" )"
                           R"(stroke-width="2"/>)",
                           x, y, kUnbiased);
  return shape + fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" font-size="11" )"
                             R"(fill="{}">{}</text>)",
                             x, y + 4.0, kInk, number);
}

/// A place for a marker at `point`, or near it where markers already stand.
glm::dvec2 free_place(const glm::dvec2& point, const std::vector<glm::dvec2>& taken) {
  constexpr double kDistance = 23.0;
  const auto is_free = [&](const glm::dvec2& place) {
    return std::all_of(taken.begin(), taken.end(), [&](const glm::dvec2& other) {
      return glm::distance(place, other) >= kDistance;
    });
  };
  // Rings of growing size; the golden angle spreads what follows another.
  for (int i = 0; i < 400; ++i) {
    const double radius = 4.0 * std::sqrt(double(i)), angle = 2.39996 * i;
    const glm::dvec2 place = point + radius * glm::dvec2(std::cos(angle), std::sin(angle));
    if (is_free(place)) return place;
  }
  return point;
}

std::string open_svg(double height, const std::string& label) {
  return fmt::format(R"(<svg viewBox="0 0 {} {:.0f}" role="img" aria-label="{}">)", kWidth, height,
                     escaped(label));
}

template <class Error>
std::string curve(const LogAxis& x, const LogAxis& y, double first, Error&& error,
                  const std::string& style) {
  constexpr int kPoints = 60;
  std::string points;
  for (int i = 0; i < kPoints; ++i) {
    const double seconds = first * std::pow(x.hi / first, double(i) / (kPoints - 1));
    points += fmt::format("{:.1f},{:.1f} ", x(seconds), y(error(seconds)));
  }
  return fmt::format(R"(<polyline points="{}" fill="none" {}/>)", points, style);
}

/// The smallest and largest of positive values, widened to leave a margin.
struct Range {
  double lo = kHighestError, hi = kLowestError;
  void add(double value) {
    if (!(value > 0.0)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

}  // namespace

std::string error_time_chart(const Study& study, const ReportInfo& info) {
  constexpr double kHeight = 560.0, kLeft = 70.0, kRight = kWidth - 20.0, kTop = 20.0,
                   kBottom = kHeight - 55.0;
  const double scale = info.scale();
  const auto error_of = [](const TrialResult& r) { return root(r.accuracy.squared_error).value; };
  double first = INFINITY, last = 0.0;
  Range errors;
  for (const TrialResult& r : study.results) {
    first = std::min(first, r.seconds);
    last = std::max(last, r.seconds);
    errors.add(error_of(r));
  }
  // Room on both sides, so that the curves show where they lead.
  first *= scale / 8.0;
  last *= scale * 15.0;
  const LogAxis x{first, last, kLeft, kRight};
  const LogAxis y{std::clamp(errors.lo / 6.0, kLowestError, 1.0),
                  std::clamp(errors.hi * 3.0, 2.0 * kLowestError, kHighestError), kBottom, kTop};

  std::string svg = open_svg(kHeight, "Relative error against time, both logarithmic");
  for (const auto& [seconds, label] : kTimeTicks) {
    if (seconds < x.lo || seconds > x.hi) continue;
    svg += line(x(seconds), kTop, x(seconds), kBottom, kGrid, 1.0);
    svg += text(x(seconds), kBottom + 18.0, "middle", label);
  }
  for (const LogAxis::Tick& tick : y.ticks()) {
    svg += line(kLeft, y(tick.value), kRight, y(tick.value), kGrid, tick.labelled ? 1.0 : 0.5);
    if (tick.labelled)
      svg += text(kLeft - 6.0, y(tick.value) + 4.0, "end", percent_text(tick.value));
  }
  svg += line(kLeft, kBottom, kRight, kBottom, kInk, 1.0) +
         line(kLeft, kTop, kLeft, kBottom, kInk, 1.0);
  svg += text(0.5 * (kLeft + kRight), kHeight - 12.0, "middle",
              fmt::format("rendering time of a picture of {} × {} on {} threads", info.full_size.x,
                          info.full_size.y, info.threads));
  svg += fmt::format(R"svg(<text transform="translate(16 {:.0f}) rotate(-90)" )svg"
                     R"(text-anchor="middle">relative RMSE</text>)",
                     0.5 * (kTop + kBottom));

  const std::vector<FrontPoint> front =
      pareto_front(study.results, first / scale, last / scale, 120);
  std::string points;
  for (const FrontPoint& p : front)
    points += fmt::format("{:.1f},{:.1f} ", x(scale * p.seconds), y(p.error));
  svg += fmt::format(
      R"(<polyline points="{}" fill="none" stroke="#f2d64b" stroke-width="11" stroke-linejoin="round"/>)",
      points);
  for (const TrialResult& r : study.results) {
    if (r.trial.spp) continue;
    const std::string style =
        r.trial.biased
            ? fmt::format(R"(stroke="{}" stroke-width="1.2" stroke-dasharray="6 4")", kBiased)
            : fmt::format(R"(stroke="{}" stroke-width="{}")", kUnbiased,
                          &r == &study.results.front() ? 2.5 : 0.8);
    svg += curve(
        x, y, std::max(first, scale * r.seconds / r.spp),
        [&](double seconds) { return std::sqrt(squared_error_after(r, seconds / scale)); }, style);
  }
  std::vector<glm::dvec2> taken;
  std::string markers;
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const TrialResult& r = study.results[i];
    const RootInterval error = root(r.accuracy.squared_error);
    const glm::dvec2 point(x(scale * r.seconds), y(error.value));
    const glm::dvec2 place = free_place(point, taken);
    taken.push_back(place);
    svg += line(point.x, y(std::max(error.low, y.lo)), point.x, y(std::max(error.high, y.lo)), kInk,
                1.5) +
           line(point.x, point.y, place.x, place.y, kInk, 0.7) +
           fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="2.5" fill="{}"/>)", point.x, point.y,
                       kInk);
    markers += marker(place.x, place.y, i + 1, r.trial.biased);
  }
  svg += markers;
  // The legend stands where no curve goes: errors fall with time.
  const double lx = kRight - 250.0;
  svg += fmt::format(R"(<rect x="{}" y="{}" width="250" height="92" fill="#fff" stroke="{}"/>)", lx,
                     kTop, kGrid);
  svg += marker(lx + 22.0, kTop + 20.0, 1, false) +
         text(lx + 44.0, kTop + 24.0, "start", "unbiased, number in the table");
  svg += marker(lx + 22.0, kTop + 46.0, 2, true) +
         text(lx + 44.0, kTop + 50.0, "start", "biased (dashed curve)");
  svg += line(lx + 8.0, kTop + 72.0, lx + 36.0, kTop + 72.0, "#f2d64b", 11.0) +
         text(lx + 44.0, kTop + 76.0, "start", "least error at each time");
  return svg + "</svg>";
}

std::string bias_chart(const Study& study) {
  constexpr double kRow = 26.0, kLeft = 250.0, kRight = kWidth - 190.0, kTop = 30.0;
  const double height = kTop + kRow * double(study.results.size()) + 40.0;
  Range range;
  for (const TrialResult& r : study.results) range.add(root(r.accuracy.squared_bias).high);
  const LogAxis x{std::clamp(range.lo / 4.0, kLowestError, 1.0),
                  std::clamp(range.hi * 1.5, 2.0 * kLowestError, kHighestError), kLeft, kRight};
  const double bottom = height - 36.0;

  std::string svg = open_svg(height, "Relative RMS bias of each setting with 95% intervals");
  for (const LogAxis::Tick& tick : x.ticks()) {
    svg += line(x(tick.value), kTop - 8.0, x(tick.value), bottom, kGrid, tick.labelled ? 1.0 : 0.5);
    if (tick.labelled)
      svg += text(x(tick.value), bottom + 18.0, "middle", percent_text(tick.value));
  }
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const TrialResult& r = study.results[i];
    const RootInterval bias = root(r.accuracy.squared_bias);
    const double y = kTop + kRow * (double(i) + 0.5);
    svg += marker(16.0, y, i + 1, r.trial.biased) + text(36.0, y + 4.0, "start", r.trial.name);
    if (bias.low > 0.0) {
      svg +=
          fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="12" fill="{}"/>)",
                      kLeft, y - 6.0, x(bias.value) - kLeft, r.trial.biased ? kBiased : kUnbiased);
      svg += line(x(bias.low), y, x(bias.high), y, kInk, 1.5) +
             line(x(bias.low), y - 5.0, x(bias.low), y + 5.0, kInk, 1.5);
    } else {
      svg += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="12" fill="#fff" )"
                         R"(stroke="#888" stroke-dasharray="3 3"/>)",
                         kLeft, y - 6.0, std::max(x(bias.high) - kLeft, 1.0));
    }
    svg += line(x(bias.high), y - 5.0, x(bias.high), y + 5.0, kInk, 1.5);
    svg += text(kRight + 12.0, y + 4.0, "start", root_text(bias));
  }
  svg += line(kLeft, kTop - 8.0, kLeft, bottom, kInk, 1.0);
  return svg + "</svg>";
}

std::string heat_legend() {
  constexpr double kLeft = 20.0, kBar = 320.0;
  constexpr int kSteps = 64;
  std::string svg =
      R"(<svg viewBox="0 0 360 46" class="legend" role="img" aria-label="Scale of the error pictures">)";
  for (int i = 0; i < kSteps; ++i) {
    const Rgb c = scale_colour((i + 0.5) / kSteps);
    svg += fmt::format(
        R"(<rect x="{:.2f}" y="2" width="{:.2f}" height="16" fill="#{:02x}{:02x}{:02x}"/>)",
        kLeft + kBar * i / kSteps, kBar / kSteps + 0.5, std::lround(255.0f * srgb_from_linear(c.r)),
        std::lround(255.0f * srgb_from_linear(c.g)), std::lround(255.0f * srgb_from_linear(c.b)));
  }
  for (const HeatMark& mark : heat_marks())
    svg += line(kLeft + kBar * mark.position, 18.0, kLeft + kBar * mark.position, 24.0, kInk, 1.0) +
           text(kLeft + kBar * mark.position, 38.0, "middle", mark.label);
  return svg + "</svg>";
}

}  // namespace brume
