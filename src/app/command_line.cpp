// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <limits>

#include "app/option_values.h"
#include "app/study_options.h"
#include "app/version.h"
#include "io/nearest_name.h"

namespace brume {
namespace {

/// An option whose text `parse` turns into a value.
template <class Value, class Result>
CLI::Option* add_parsed(CLI::App& command, const char* name, const char* type_name, Value& value,
                        Result (*parse)(const char*, const std::string&), const char* description) {
  return command
      .add_option_function<std::string>(
          name, [&value, name, parse](const std::string& text) { value = parse(name, text); },
          description)
      ->type_name(type_name);
}

void add_input(CLI::App& command, std::string& input, const char* description) {
  const auto not_empty = [](const std::string& text) -> std::string {
    return text.empty() ? "the name is empty" : "";
  };
  auto* positional = command.add_option("INPUT", input, description)->required()->check(not_empty);
  // The positional is satisfied by -s FILE too.
  command
      .add_option_function<std::string>(
          "-s,--scene",
          [&input, positional](const std::string& file) {
            input = file;
            positional->required(false);
          },
          "The same as INPUT")
      ->check(not_empty)
      ->trigger_on_parse();
}

void add_definitions(CLI::App& command, std::map<std::string, std::string>& definitions) {
  command
      .add_option_function<std::vector<std::string>>(
          "-D",
          [&definitions](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              const auto [name, value] = parse_definition("-D", text);
              definitions.insert_or_assign(name, value);
            }
          },
          "Value of a scene parameter that the scene declares with <default>")
      ->type_name("name=value")
      ->allow_extra_args(false);
}

/// The table of settings, for help.
std::string describe_settings() {
  const EstimatorSettings defaults;
  std::string text =
      "Settings (--set NAME=VALUE; --set textbook: what renderers commonly do, to compare with)\n";
  for (const Setting& setting : setting_table())
    text += fmt::format("  {:<16} {} (default {})\n{:19}{}\n", setting.name, setting.values,
                        setting.value(defaults), "", setting.meaning);
  return text;
}

void add_settings(CLI::App& command, EstimatorSettings& settings) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&settings](const std::vector<std::string>& assignments) {
            for (const std::string& assignment : assignments) apply_setting(assignment, settings);
          },
          "How the picture is computed, see below; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->group("The picture");
  command.footer(describe_settings());
}

/// Options of a volume that has no scene.
void add_volume_options(CLI::App& command, RenderOptions& options) {
  const auto volume = "A bare volume (the scene around it is made to fit and printed)";
  command.add_option("--grid", options.grid, "Density grid by name, or name[index] of several")
      ->type_name("NAME")
      ->group(volume);
  command
      .add_option("--density-scale", options.density_scale,
                  "Extinction per density [1/unit]; default: from the optical thickness")
      ->check(number_between(std::numeric_limits<float>::min(), std::numeric_limits<float>::max()))
      ->type_name("X")
      ->group(volume);
  add_parsed(command, "--albedo", "R[,G,B]", options.albedo, parse_albedo,
             "Single-scattering albedo in [0, 1]")
      ->group(volume);
  command
      .add_option("--g", options.g, "Asymmetry of Henyey-Greenstein scattering, forward positive")
      ->check(number_between(-1.0, 1.0))
      ->type_name("X")
      ->group(volume);
}

void add_render(CLI::App& app, RenderOptions& options) {
  CLI::App& render = *app.add_subcommand("render", "Render a scene or a volume to picture files");
  add_input(render, options.input, "Scene (.xml) or volume (.vdb, .nvdb, .vol)");
  render
      .add_option("-o,--output", options.outputs,
                  "Picture to write: .exr (linear, with opacity and error layers), .png, .jpg or "
                  ".hdr; may be repeated. Default: INPUT's name with .exr, in this folder")
      ->type_name("FILE")
      ->allow_extra_args(false);

  const auto stop = "When to stop (the first one reached; default: the scene's sample_count)";
  render.add_option("--spp", options.spp, "Samples a pixel; no pixel gets more")
      ->check(CLI::Range(1u, 1u << 30))
      ->type_name("N")
      ->group(stop);
  add_parsed(render, "--time", "DURATION", options.seconds, parse_duration,
             "Time to spend, loading and writing included: 90s, 5m, 1.5h")
      ->group(stop);
  add_parsed(render, "--error", "E", options.error, parse_error,
             "Relative RMS error of the picture, with 95% confidence: 1% or 0.01")
      ->group(stop);
  render
      .add_flag_callback(
          "--no-adaptive", [&] { options.adaptive = false; },
          "With --time or --error: as many samples for each pixel, not more where the error is")
      ->group(stop);

  const auto picture = "The picture";
  add_parsed(render, "--size", "WxH", options.size, parse_size,
             "Size in pixels instead of the scene's")
      ->group(picture);
  render
      .add_option("--exposure", options.exposure,
                  "Brightness of .png and .jpg in stops; each doubles it")
      ->check(number_between(-100.0, 100.0))
      ->type_name("STOPS")
      ->group(picture);
  render.add_option("--aov", options.layers, "More layers in .exr files: albedo, depth")
      ->check(CLI::IsMember({"albedo", "depth"}))
      ->delimiter(',')
      ->type_name("LIST")
      ->group(picture);
  render
      .add_option("--max-depth", options.max_depth,
                  "Longest path: 1 is emitted light only, 2 one scattering, -1 no limit")
      ->check(CLI::Range(-1, 1 << 30))
      ->type_name("N")
      ->group(picture);
  add_definitions(render, options.definitions);

  add_settings(render, options.settings);

  add_volume_options(render, options);

  const auto run = "The run";
  render.add_option("--seed", options.seed, "Same seed, same bits")->type_name("N")->group(run);
  render.add_option("--threads", options.threads, "Default: all processors; the bits are the same")
      ->check(CLI::Range(1, 4096))
      ->type_name("N")
      ->group(run);
  render.add_flag("--quiet", options.quiet, "Print warnings and errors only")->group(run);
  add_parsed(render, "--checkpoint-every", "DURATION", options.checkpoint_every, parse_duration,
             "Save all that --resume needs beside the first output (FILE.checkpoint), in such "
             "intervals and at the end")
      ->group(run);
  render
      .add_flag("--resume", options.resume,
                "Go on from the first output's checkpoint, if there is one, with the same bits as "
                "if nothing had stopped the render; saves one at the end")
      ->group(run);
  render.add_option("--json", options.statistics_path, "Write statistics for programs to FILE")
      ->type_name("FILE")
      ->group(run);
}

void add_trade(CLI::App& app, TradeOptions& options) {
  CLI::App& trade = *app.add_subcommand(
      "trade", "Measure speed against accuracy on a scene: table, report with plots, what to use");
  add_input(trade, options.render.input, "Scene (.xml) or volume (.vdb, .nvdb, .vol)");
  add_parsed(trade, "--budget", "DURATION", options.budget, parse_duration,
             "Time to spend on everything: 90s, 5m, 1.5h; default 5m");
  trade
      .add_option("-o,--output", options.report_path,
                  "Report to write (.html, one page that needs no other file); .csv and .json of "
                  "the same name are written beside it")
      ->type_name("REPORT");
  trade
      .add_option("--reference", options.reference_path,
                  "Picture to measure against, such as one rendered overnight; its size is taken. "
                  "Default: a third of the time is spent on one")
      ->type_name("FILE");
  add_parsed(trade, "--size", "WxH", options.render.size, parse_size,
             "Size of the pictures rendered; default: small enough for the time. Times are given "
             "for the scene's own");
  add_definitions(trade, options.render.definitions);
  add_volume_options(trade, options.render);
  trade.add_option("--threads", options.render.threads, "Default: all processors")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  trade.add_flag("--quiet", options.render.quiet, "Print the result, warnings and errors only");
}

void add_info(CLI::App& app, InfoOptions& options) {
  CLI::App& info = *app.add_subcommand(
      "info", "Say what a scene or volume holds and what rendering it will require");
  add_input(info, options.input, "Scene (.xml) or volume (.vdb, .nvdb, .vol)");
  add_definitions(info, options.definitions);
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// `unknown` as the user wrote it, with the nearest option or command.
std::string unknown_word_message(const CLI::App& app, const std::string& unknown) {
  const auto chosen = app.get_subcommands();
  std::vector<std::string> names;
  if (unknown.starts_with("-")) {
    for (const CLI::Option* option : (chosen.empty() ? &app : chosen.front())->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return fmt::format("unknown option \"{}\"{}", unknown, suggestion(unknown, names));
  }
  if (!chosen.empty()) return fmt::format("one argument too many: \"{}\"", unknown);
  return fmt::format("unknown command \"{}\"{}", unknown, suggestion(unknown, command_names(app)));
}

int report_mistake(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  // A command that is missing is one that was misspelt, if there is any word that nothing knows.
  const bool lacks_command = app.get_subcommands().empty();
  const std::vector<std::string> rest = app.remaining(true);
  if (!rest.empty() && (lacks_command || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr))
    message = unknown_word_message(app, rest.front());
  else if (lacks_command)
    message = fmt::format("a command is needed: {}", fmt::join(command_names(app), ", "));
  fmt::print(stderr, "brume: {}\nTry: brume {}--help\n", message,
             lacks_command ? "" : app.get_subcommands().front()->get_name() + " ");
  return 2;
}

}  // namespace

std::variant<RenderOptions, InfoOptions, CompareOptions, TradeOptions, Done> parse_command_line(
    int argc, char** argv) {
  CLI::App app("brume: unbiased renderer for fog, smoke, fire and clouds", "brume");
  app.set_version_flag("--version", std::string("brume ") + kVersion);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  brume render cloud.vdb -o cloud.png\n"
      "  brume render fog.xml --spp 256 -o fog.exr -o fog.png\n"
      "  brume render fog.xml --time 90s -D fog_sigma_t=0.5\n"
      "  brume render fog.xml --error 1% --checkpoint-every 60s --resume\n"
      "  brume info cloud.vdb\n"
      "  brume compare fog.exr reference.exr -o error.png\n"
      "  brume trade fog.xml --budget 5m -o fog_trade.html\n\n"
      "Exit codes: 0 done; 1 could not finish; 2 wrong usage or bad input; 130 interrupted, with\n"
      "what was rendered saved.");

  RenderOptions render;
  InfoOptions info;
  CompareOptions compare;
  TradeOptions trade;
  add_render(app, render);
  add_info(app, info);
  add_compare(app, compare);
  add_trade(app, trade);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for) {  // --help and --version
    return Done{app.exit(asked_for)};
  } catch (const CLI::ParseError& error) {
    return Done{report_mistake(app, error)};
  }
  if (app.got_subcommand("render")) return render;
  if (app.got_subcommand("compare")) return compare;
  if (app.got_subcommand("trade")) return trade;
  return info;
}

}  // namespace brume
