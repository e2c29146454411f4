// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace brume {

/// A text file as it was read, kept so that a message can show the line it speaks of.
struct SourceFile {
  std::filesystem::path path;  // as the person gave it, for messages
  std::string text;            // UTF-8
};

/// Throws an input error that names the path when it leads to a folder, a device or a pipe, which
/// could be read for ever. A path that leads nowhere passes: opening it tells why.
void require_file(const std::filesystem::path& path);

/// Throws what errno says about a file that could not be opened: an input error where there is
/// none.
[[noreturn]] void fail_to_open(const std::filesystem::path& path);

/// Reads a file whole. Throws an input error that names the path when there is none to read.
std::string read_whole_file(const std::filesystem::path& path);

/// A place in a file, or nowhere in particular when `file` is empty.
struct SourcePosition {
  std::shared_ptr<const SourceFile> file;
  std::size_t offset = 0;  // [bytes]

  /// `path:line:column`, both counted from 1, columns in characters.
  std::string to_string() const;
};

/// Throws an Error: the place and the message, then the line in question with a caret under the
/// place.
[[noreturn]] void fail_at(const SourcePosition& where, const std::string& message);

}  // namespace brume
