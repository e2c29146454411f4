// SPDX-License-Identifier: Apache-2.0
#include "io/source_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/error.h"

namespace brume {
namespace {

constexpr std::size_t kExcerptBefore = 60;  // [characters] shown on either side of the caret
constexpr std::size_t kExcerptAfter = 40;

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

std::size_t line_start(const std::string& text, std::size_t offset) {
  if (offset == 0) return 0;
  const std::size_t newline = text.rfind('\n', offset - 1);
  return newline == std::string::npos ? 0 : newline + 1;
}

// The line around `offset`, cut to a screen's width, and a caret below the place.
std::string excerpt(const std::string& text, std::size_t offset) {
  std::size_t first = line_start(text, offset);
  std::size_t last = std::min(text.find('\n', offset), text.size());
  if (last > first && text[last - 1] == '\r') --last;
  last = std::max(last, offset);
  const bool cut_left = offset - first > kExcerptBefore;
  const bool cut_right = last - offset > kExcerptAfter;
  if (cut_left) first = offset - kExcerptBefore;
  if (cut_right) last = offset + kExcerptAfter;
  while (first < offset && continues_character(text[first])) ++first;
  while (last > offset && last < text.size() && continues_character(text[last])) --last;

  std::string padding;
  for (std::size_t i = first; i < offset; ++i) {
    if (!continues_character(text[i])) padding += text[i] == '\t' ? '\t' : ' ';
  }
  return fmt::format("  {}{}{}\n  {}{}^", cut_left ? "..." : "", text.substr(first, last - first),
                     cut_right ? "..." : "", cut_left ? "   " : "", padding);
}

}  // namespace

void require_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw Error(fmt::format("{}: is a folder, not a file", path.string()));
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(fmt::format("{}: is a device or a pipe, not a file", path.string()));
}

void fail_to_open(const std::filesystem::path& path) {
  throw Error(fmt::format("{}: {}", path.string(), std::strerror(errno)),
              errno == ENOENT ? ErrorKind::kInput : ErrorKind::kEnvironment);
}

std::string read_whole_file(const std::filesystem::path& path) {
  require_file(path);
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) fail_to_open(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> closer(file, &std::fclose);
  std::string text;
  char block[1 << 16];
  while (const std::size_t n = std::fread(block, 1, sizeof block, file)) text.append(block, n);
  if (std::ferror(file) != 0) {
    throw Error(fmt::format("{}: {}", path.string(), std::strerror(errno)),
                ErrorKind::kEnvironment);
  }
  return text;
}

std::string SourcePosition::to_string() const {
  const std::string& text = file->text;
  const auto end = text.begin() + std::ptrdiff_t(std::min(offset, text.size()));
  const auto start = text.begin() + std::ptrdiff_t(line_start(text, std::min(offset, text.size())));
  const auto line = 1 + std::count(text.begin(), end, '\n');
  const auto column = 1 + std::count_if(start, end, [](char c) { return !continues_character(c); });
  return fmt::format("{}:{}:{}", file->path.string(), line, column);
}

void fail_at(const SourcePosition& where, const std::string& message) {
  if (where.file == nullptr) throw Error(message);
  const std::size_t offset = std::min(where.offset, where.file->text.size());
  throw Error(
      fmt::format("{}: {}\n{}", where.to_string(), message, excerpt(where.file->text, offset)));
}

}  // namespace brume
