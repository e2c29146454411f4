// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace brume::test {

/// How a run of the program ended.
struct Ended {
  int exit_code;    // 128 + the signal that killed it; -1 when it had to be stopped
  std::string out;  // what it wrote to stdout
  std::string err;  // to stderr
  double seconds;
};

/// Where the program writes its progress.
enum class ErrorStream { kFile, kTerminal };

/// Whether the machine hands out terminals; some containers do not.
bool has_terminals();

struct ProgramRun {
  std::vector<std::string> arguments;
  std::filesystem::path folder;  // the current one
  ErrorStream stderr_is = ErrorStream::kFile;
  /// Called once with its process id after it began to listen to Ctrl-C.
  std::function<void(pid_t)> when_listening{};
};

/// Runs brume as a shell would. One that takes longer than two minutes is stopped.
Ended run_brume(const ProgramRun& run);

}  // namespace brume::test
