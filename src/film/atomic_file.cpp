// SPDX-License-Identifier: Apache-2.0
#include "film/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace brume {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(fmt::format("{}: cannot be written: {}", path, reason), ErrorKind::kEnvironment);
}

std::string reason_of(int error_number) {
  return std::generic_category().message(error_number);
}

/// The file that is replaced: a link stays a link, what it points to is written.
fs::path resolve(const fs::path& path) {
  std::error_code ignored, dangling;
  const fs::path pointed_to = fs::canonical(path, dangling);
  return fs::is_symlink(path, ignored) && !dangling ? pointed_to : path;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A file beside `target` that disappears unless it is renamed to it.
class TemporaryFile {
 public:
  /// Without a name, where the file system can do that: then not even a killed program leaves it.
  explicit TemporaryFile(const fs::path& target)
      : target_(target),
        path_(folder_of(target) /
              fmt::format(".{}.{}.partial", target.filename().string(), ::getpid())),
        descriptor_(::open(folder_of(target).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666)) {
    if (descriptor_ >= 0) return;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    has_name_ = descriptor_ >= 0;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (has_name_) ::unlink(path_.c_str());
  }

  bool is_open() const { return descriptor_ >= 0; }

  /// False, with errno set, when not all of `bytes` could be written.
  bool write(std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return false;
      bytes = bytes.subspan(std::size_t(count));
    }
    return true;
  }

  /// False, with errno set, when the bytes did not reach the disk or the file could not be moved.
  bool replace_target() {
    if (::fsync(descriptor_) != 0 || !give_name()) return false;
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0 || std::rename(path_.c_str(), target_.c_str()) != 0) return false;
    has_name_ = false;
    return true;
  }

 private:
  bool give_name() {
    if (has_name_) return true;
    ::unlink(path_.c_str());
    has_name_ = ::linkat(AT_FDCWD, fmt::format("/proc/self/fd/{}", descriptor_).c_str(), AT_FDCWD,
                         path_.c_str(), AT_SYMLINK_FOLLOW) == 0;
    return has_name_;
  }

  fs::path target_, path_;
  int descriptor_;
  bool has_name_ = false;
};

}  // namespace

void check_writable(const std::string& path) {
  const fs::path target = resolve(path);
  const fs::path folder = folder_of(target);
  std::error_code ignored;
  if (!fs::exists(folder, ignored))
    fail(path, fmt::format("there is no folder {}", folder.string()));
  if (!fs::is_directory(folder, ignored))
    fail(path, fmt::format("{} is not a folder", folder.string()));
  if (fs::is_directory(target, ignored)) fail(path, "it is a folder");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    fail(path, fmt::format("folder {}: {}", folder.string(), reason_of(errno)));
}

void write_file_atomically(const std::string& path, std::span<const unsigned char> bytes) {
  write_file_atomically(path, std::span(&bytes, 1));
}

void write_file_atomically(const std::string& path,
                           std::span<const std::span<const unsigned char>> pieces) {
  check_writable(path);
  TemporaryFile file(resolve(path));
  bool good = file.is_open();
  for (const std::span<const unsigned char> piece : pieces) good = good && file.write(piece);
  if (!good || !file.replace_target()) fail(path, reason_of(errno));
}

}  // namespace brume
