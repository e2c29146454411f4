// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "core/error.h"
#include "film/atomic_file.h"
#include "film/read_image.h"
#include "film/write_image.h"
#include "study/comparison.h"
#include "study/heat_map.h"

namespace brume {
namespace {

std::string text(const glm::dvec3& v) {
  return fmt::format("{:.5g} {:.5g} {:.5g}", v.r, v.g, v.b);
}

std::string percent(double x) {
  return fmt::format("{:.3g}%", 100.0 * x);
}

void print_line(std::string_view name, const std::string& value) {
  fmt::print("{:<15}{}\n", name, value);
}

void print_same_picture(const SamePicture& same, bool both_have_errors) {
  print_line("z-scores",
             fmt::format("mean square {:.4g} (1 expected), {} beyond 3 (0.27%), of {} "
                         "values",
                         same.mean_square_z, percent(same.share_beyond_3), same.compared));
  if (same.unknown > 0)
    print_line("", fmt::format("{} values left out: their error is not known", same.unknown));
  if (same.impossible > 0)
    print_line("", fmt::format("{} values differ although both pictures claim them to be exact",
                               same.impossible));
  print_line("same picture",
             fmt::format("p = {:.3g}{}", same.p_same,
                         both_have_errors ? "" : ", if the picture without error layers is exact"));
}

void print(const CompareOptions& options, const Comparison& c, bool both_have_errors) {
  print_line("A", options.picture);
  print_line("B", options.reference + " (the reference)");
  print_line("mean of A", text(c.mean));
  print_line("mean of B", text(c.reference_mean));
  print_line("bias", text(c.bias) + (c.bias_error ? " +- " + text(*c.bias_error) : ""));
  print_line("RMSE", fmt::format("{:.5g}", c.rmse));
  print_line("relative RMSE", percent(c.relative_rmse) + " of B's mean radiance");
  print_line("relative MSE",
             fmt::format("{:.5g}, each pixel by its own radiance and at least {:.3g}",
                         c.relative_mse, c.epsilon));
  print_line("PSNR", fmt::format("{:.2f} dB below B's largest value", c.psnr));
  for (std::size_t i = 0; i < c.worst.size(); ++i)
    print_line(i == 0 ? "worst pixels" : "",
               fmt::format("({}, {}): {}, in B {}", c.worst[i].x, c.worst[i].y,
                           text(c.worst[i].value), text(c.worst[i].reference)));
  if (c.same) print_same_picture(*c.same, both_have_errors);
}

/// JSON has no infinity: what is not known is null.
nlohmann::json number(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json();
}
nlohmann::json array(const glm::dvec3& v) {
  return {number(v.r), number(v.g), number(v.b)};
}

void write_json(const CompareOptions& options, const Comparison& c) {
  nlohmann::ordered_json json = {
      {"picture", options.picture},
      {"reference", options.reference},
      {"mean", array(c.mean)},
      {"reference_mean", array(c.reference_mean)},
      {"bias", array(c.bias)},
      {"bias_standard_error", c.bias_error ? array(*c.bias_error) : nlohmann::json()},
      {"rmse", number(c.rmse)},
      {"relative_rmse", number(c.relative_rmse)},
      {"relative_mse", number(c.relative_mse)},
      {"relative_mse_epsilon", number(c.epsilon)},
      {"psnr_db", number(c.psnr)},
      {"worst_pixels", nlohmann::json::array()},
  };
  for (const PixelDifference& pixel : c.worst)
    json["worst_pixels"].push_back({{"x", pixel.x},
                                    {"y", pixel.y},
                                    {"value", array(pixel.value)},
                                    {"reference", array(pixel.reference)}});
  if (c.same)
    json["same_picture"] = {
        {"values_compared", c.same->compared},      {"values_unknown", c.same->unknown},
        {"values_impossible", c.same->impossible},  {"mean_square_z", c.same->mean_square_z},
        {"share_beyond_3", c.same->share_beyond_3}, {"p", c.same->p_same}};
  const std::string text = json.dump(2) + "\n";
  write_file_atomically(options.json_path,
                        {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

}  // namespace

int run_compare(const CompareOptions& options) {
  if (!options.heat_map_path.empty()) check_output_path(options.heat_map_path);
  if (!options.json_path.empty()) check_writable(options.json_path);
  const Image picture = read_image_with_errors(options.picture);
  const Image reference = read_image_with_errors(options.reference);
  const Comparison comparison = compare(picture, reference);
  if (!options.heat_map_path.empty())
    write_image(options.heat_map_path, with_legend(heat_map(picture, reference)));
  if (!options.json_path.empty()) write_json(options, comparison);
  print(options, comparison,
        picture.channel("stderr.R").has_value() && reference.channel("stderr.R").has_value());
  return 0;
}

}  // namespace brume
