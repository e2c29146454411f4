// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <new>

#include "app/command_line.h"
#include "app/commands.h"
#include "core/error.h"

namespace {

int run(int argc, char** argv) {
  const auto command = brume::parse_command_line(argc, argv);
  if (const auto* done = std::get_if<brume::Done>(&command)) return done->exit_code;
  if (const auto* options = std::get_if<brume::RenderOptions>(&command))
    return brume::run_render(*options);
  if (const auto* options = std::get_if<brume::CompareOptions>(&command))
    return brume::run_compare(*options);
  if (const auto* options = std::get_if<brume::TradeOptions>(&command))
    return brume::run_trade(*options);
  return brume::run_info(std::get<brume::InfoOptions>(command));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const brume::Error& error) {
    fmt::print(stderr, "brume: {}\n", error.what());
    return error.kind() == brume::ErrorKind::kInput ? 2 : 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "brume: out of memory; a smaller picture or volume may fit\n");
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "brume: {}\n", error.what());
    return 1;
  }
}
