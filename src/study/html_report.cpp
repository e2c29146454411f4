// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/rgb.h"
#include "film/write_image.h"
#include "study/charts.h"
#include "study/data_uri.h"
#include "study/heat_map.h"
#include "study/picture.h"
#include "study/recommendation.h"
#include "study/report_text.h"
#include "study/trade_report.h"

namespace brume {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #1a1a1a; background: #fff;
  max-width: 1000px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; margin-bottom: 0.2em; }
h2 { font-size: 1.2em; margin-top: 2em; }
svg { display: block; width: 100%; height: auto; font-size: 13px; }
svg.legend { width: 360px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th, td { padding: 0.25em 0.6em; text-align: right; border-bottom: 1px solid #ddd;
  white-space: nowrap; }
th { border-bottom: 2px solid #1a1a1a; }
th.name, td.name { text-align: left; }
tr.biased td.name::after { content: " (biased)"; color: #8a4b08; }
code { font: 13px "DejaVu Sans Mono", monospace; white-space: pre-wrap; }
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr));
  gap: 1.2em; }
figure { margin: 0; break-inside: avoid; }
figure div { display: flex; gap: 4px; }
figure img { width: 50%; height: auto; }
figure.whole img { width: 100%; }
figcaption { font-size: 14px; }
@media print {
  body { margin: 0; max-width: none; font-size: 10pt; }
  h2 { break-after: avoid; }
  svg, table { break-inside: avoid; }
  table { font-size: 8.5pt; }
}
)css";

/// Exposure that brings all but the brightest twentieth of the pixels onto the screen [stops].
float exposure_of(const Image& image) {
  const Picture picture(image);
  std::vector<double> brightness;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const glm::dvec3 c = picture.colour(x, y);
      brightness.push_back(std::max({c.r, c.g, c.b}));
    }
  const auto bright = brightness.begin() + std::ptrdiff_t(brightness.size() * 19 / 20);
  std::nth_element(brightness.begin(), bright, brightness.end());
  return *bright > 0.0 ? float(-std::log2(*bright)) : 0.0f;
}

std::string img(const Image& image, float exposure, const std::string& description) {
  return fmt::format(R"(<img src="{}" alt="{}" width="{}" height="{}">)",
                     png_data_uri(encode_png(image, {.exposure = exposure})), escaped(description),
                     image.width, image.height);
}

std::string command(const ReportInfo& info, const TrialResult& result, std::uint32_t spp) {
  std::string words = info.command;
  for (const std::string& option : result.trial.options) words += " " + option;
  return words + fmt::format(" --spp {}", spp);
}

std::string recommendations(const Study& study, const ReportInfo& info) {
  std::string html =
      "<table id=\"recommendations\"><thead><tr><th>error</th><th>time</th><th>by default</th>"
      "<th class=\"name\">command</th></tr></thead><tbody>\n";
  for (const Recommendation& r : recommend(study.results)) {
    const TrialResult& result = study.results[r.trial];
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"name\"><code>{}</code></td></tr>\n",
        percent_text(r.target), duration_text(info.scale() * r.seconds),
        duration_text(info.scale() * r.default_seconds), escaped(command(info, result, r.spp)));
  }
  return html + "</tbody></table>\n";
}

std::string table(const Study& study, const ReportInfo& info) {
  std::string html =
      "<table id=\"settings\"><thead><tr><th></th><th class=\"name\">setting</th><th>samples</th>"
      "<th>time</th><th>error</th><th>bias</th><th>bias of the mean</th><th>efficiency</th>"
      "<th>memory</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const TrialResult& r = study.results[i];
    html += fmt::format(
        "<tr{}><td>{}</td><td class=\"name\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{:.2f}</td><td>{}</td></tr>\n",
        r.trial.biased ? " class=\"biased\"" : "", i + 1, escaped(r.trial.name), r.spp,
        duration_text(info.scale() * r.seconds), root_text(root(r.accuracy.squared_error)),
        root_text(root(r.accuracy.squared_bias)), signed_text(r.accuracy.mean_bias),
        efficiency(r, study.results.front()), memory_text(r.memory_bytes));
  }
  return html + "</tbody></table>\n";
}

std::string gallery(const Study& study) {
  const Image reference = best_picture(study.reference);
  const float exposure = exposure_of(reference);
  std::string html = "<div class=\"gallery\">\n<figure class=\"whole\"><div>" +
                     img(reference, exposure, "The reference") +
                     "</div><figcaption>The reference</figcaption></figure>\n";
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const TrialResult& r = study.results[i];
    html += fmt::format(
        "<figure><div>{}{}</div><figcaption>{} {}: one picture of {} samples; error of the mean of "
        "{}</figcaption></figure>\n",
        img(r.picture, exposure, r.trial.name),
        img(heat_map(r.mean, reference), 0.0f, "Relative error of " + r.trial.name), i + 1,
        escaped(r.trial.name), r.spp, r.seeds);
  }
  return html + "</div>\n";
}

std::string method(const Study& study, const ReportInfo& info) {
  const std::string reference =
      study.reference_spp
          ? fmt::format(
                "The reference is two independent renders of {} samples a pixel with the "
                "default settings.",
                *study.reference_spp)
          : std::string("The reference is the picture that was given.");
  std::string html = fmt::format(
      "<p>Measured on pictures of {} × {} pixels in {} (of {}); times are processor time over {} "
      "threads, {} for the scene's own {} × {}. {} Errors are relative to the "
      "reference's mean radiance: the root of the squared error averaged over pixels and channels. "
      "Bias is the part of it that more samples do not remove. It is computed from products of "
      "different pictures' differences from the reference, which hold no noise on average; "
      "intervals are of 95%, from the spread over pixels. Efficiency says how many times faster "
      "than "
      "the default a setting reaches the error of the default's first row; 0: its bias does not "
      "let "
      "it. A setting is recommended instead of the default only where it is faster by more than "
      "the "
      "intervals, and by a tenth on top, or by a half if it is biased; its bias counts at the "
      "upper "
      "end of its interval.</p>\n",
      info.size.x, info.size.y, duration_text(info.seconds), duration_text(info.budget),
      info.threads, info.scale() == 1.0 ? "as they are" : "scaled by the number of pixels",
      info.full_size.x, info.full_size.y, reference);
  if (study.skipped.empty()) return html;
  html += "<p>Not measured:</p><ul>\n";
  for (const std::string& reason : study.skipped)
    html += fmt::format("<li>{}</li>\n", escaped(reason));
  return html + "</ul>\n";
}

}  // namespace

std::string html_report(const Study& study, const ReportInfo& info) {
  const std::string title = "Speed against accuracy: " + escaped(info.input);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{0}</title>\n<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n<p>brume {2}{3}</p>\n"
      "<h2>What to use for an error</h2>\n{4}"
      "<h2>Error against time</h2>\n{5}\n"
      "<h2>Settings</h2>\n{6}"
      "<h2>Bias</h2>\n{7}\n"
      "<h2>Pictures</h2>\n<p>Left, what one run gives. Right, how far the mean of all runs is from "
      "the reference, where noise is partly averaged out and bias is not.</p>\n{8}{9}"
      "<h2>How this was measured</h2>\n{10}</body></html>\n",
      title, kStyle, info.version, study.complete ? "" : " — the study was stopped early",
      recommendations(study, info), error_time_chart(study, info), table(study, info),
      bias_chart(study), heat_legend(), gallery(study), method(study, info));
}

}  // namespace brume
