// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/temporary_folder.h"

namespace brume::test {
namespace {

using Clock = std::chrono::steady_clock;

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return (std::ostringstream() << file.rdbuf()).str();
}

/// Whether the process catches SIGINT, as the kernel tells.
bool listens_to_interrupt(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:"))
      return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1)) & 1u;
  return false;
}

/// What has arrived at the terminal so far.
void drain(int terminal, std::string& text) {
  pollfd ready{.fd = terminal, .events = POLLIN, .revents = 0};
  char buffer[4096];
  while (::poll(&ready, 1, 0) > 0 && (ready.revents & POLLIN) != 0) {
    const ssize_t count = ::read(terminal, buffer, sizeof buffer);
    if (count <= 0) return;
    text.append(buffer, std::size_t(count));
  }
}

[[noreturn]] void become_brume(const ProgramRun& run, int out, int err) {
  if (::chdir(run.folder.c_str()) != 0) ::_exit(126);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::setenv("TERM", "xterm", 1);
  std::signal(SIGINT, SIG_DFL);
  std::vector<std::string> words{"brume"};
  words.insert(words.end(), run.arguments.begin(), run.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(BRUME_PROGRAM, argv.data());
  ::_exit(127);
}

}  // namespace

bool has_terminals() {
  int main_end = -1, program_end = -1;
  if (::openpty(&main_end, &program_end, nullptr, nullptr, nullptr) != 0) return false;
  ::close(main_end);
  ::close(program_end);
  return true;
}

Ended run_brume(const ProgramRun& run) {
  const TemporaryFolder streams;
  const auto create = [&](const char* name) {
    return ::open((streams.path() / name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  };
  const bool has_terminal = run.stderr_is == ErrorStream::kTerminal;
  const int out = create("out");
  int err = -1, terminal = -1;
  if (has_terminal) {
    winsize size{.ws_row = 25, .ws_col = 100, .ws_xpixel = 0, .ws_ypixel = 0};
    if (::openpty(&terminal, &err, nullptr, nullptr, &size) != 0)
      throw std::runtime_error("no pseudo-terminal");
  } else {
    err = create("err");
  }

  const auto begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const pid_t pid = ::fork();
  if (pid == 0) become_brume(run, out, err);
  ::close(out);
  ::close(err);

  constexpr double kTooLong = 120.0;  // [s]
  Ended ended{.exit_code = -1, .out = {}, .err = {}, .seconds = 0.0};
  bool told = !run.when_listening;
  int status = 0;
  bool alive = true;
  while (alive) {
    alive = ::waitpid(pid, &status, WNOHANG) == 0;
    if (has_terminal) drain(terminal, ended.err);
    if (alive && !told && listens_to_interrupt(pid)) {
      told = true;
      run.when_listening(pid);
    }
    if (alive && seconds() > kTooLong) {
      ::kill(pid, SIGKILL);
      ::waitpid(pid, &status, 0);
      break;
    }
    if (alive) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ended.seconds = seconds();
  if (!alive) ended.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ended.out = contents(streams.path() / "out");
  if (has_terminal)
    ::close(terminal);
  else
    ended.err = contents(streams.path() / "err");
  return ended;
}

}  // namespace brume::test
