// SPDX-License-Identifier: Apache-2.0
#include "render/checkpoint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>

#include "core/byte_hash.h"
#include "core/error.h"
#include "film/atomic_file.h"
#include "film/film.h"

namespace brume {
namespace {

// The file, in the byte order of the machine (x86: little-endian):
//   Header | fingerprint: name \0 value \0 ... | hash of what is before
//   Summary | pixels | hash of everything before

using Bytes = std::span<const unsigned char>;

constexpr std::array<char, 16> kMagic{"brume state\r\n\x1a"};
constexpr std::uint64_t kFormat = 2;
constexpr std::uint64_t kLongestFingerprint = 1u << 24;  // [bytes]

struct Header {
  std::array<char, 16> magic = kMagic;
  std::uint64_t format = kFormat;
  std::uint64_t fingerprint_bytes = 0;
};

struct Summary {
  RenderState state;
  std::uint64_t bad_samples = 0;
  std::uint32_t bad_x = 0, bad_y = 0;
};

template <class T>
Bytes bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const unsigned char*>(&value), sizeof value};
}

std::string to_text(const Fingerprint& fingerprint) {
  std::string text;
  for (const auto& [name, value] : fingerprint) text += name + '\0' + value + '\0';
  return text;
}

Fingerprint from_text(const std::string& text) {
  Fingerprint fingerprint;
  std::size_t begin = 0;
  const auto next = [&] {
    const std::size_t end = std::min(text.find('\0', begin), text.size());
    std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    return word;
  };
  while (begin < text.size()) {
    std::string name = next();
    fingerprint.emplace_back(std::move(name), next());
  }
  return fingerprint;
}

std::string value_in_words(const Fingerprint& fingerprint, const std::string& name) {
  const auto found = std::find_if(fingerprint.begin(), fingerprint.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found == fingerprint.end() ? "none" : found->second;
}

/// Each value that differs, in words.
std::vector<std::string> differences(const Fingerprint& there, const Fingerprint& here) {
  std::vector<std::string> names;
  for (const Fingerprint& fingerprint : {there, here})
    for (const auto& [name, value] : fingerprint)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  std::vector<std::string> result;
  for (const std::string& name : names) {
    const std::string value_there = value_in_words(there, name);
    const std::string value_here = value_in_words(here, name);
    if (value_there != value_here)
      result.push_back(fmt::format("{}: {} there, {} here", name, value_there, value_here));
  }
  return result;
}

/// Reads a checkpoint piece by piece and hashes it on the way.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "rb")) {
    if (file_ == nullptr)
      throw Error(fmt::format("{}: {}", path, std::strerror(errno)), ErrorKind::kEnvironment);
  }

  void read(std::span<unsigned char> bytes) {
    if (std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
      if (std::ferror(file_.get()) != 0)
        throw Error(fmt::format("{}: {}", path_, std::strerror(errno)), ErrorKind::kEnvironment);
      fail("it ends too early");
    }
    hash_.add(bytes);
  }
  template <class T>
  T read() {
    T value;
    read({reinterpret_cast<unsigned char*>(&value), sizeof value});
    return value;
  }
  /// Reads the hash of all that was read before.
  void check_hash() {
    const std::uint64_t expected = hash_.value();
    if (read<std::uint64_t>() != expected) fail("its checksum does not agree with what it holds");
  }
  void check_end() {
    if (std::fgetc(file_.get()) != EOF) fail("something follows its end");
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(
        fmt::format("{} is damaged: {}; remove it to render from the start", path_, reason));
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::string& path_;
  std::unique_ptr<std::FILE, Close> file_;
  ByteHash hash_;
};

Fingerprint read_fingerprint(Reader& reader, const std::string& path) {
  const Header header = reader.read<Header>();
  if (header.magic != kMagic) throw Error(fmt::format("{} is no checkpoint of brume", path));
  if (header.format != kFormat)
    throw Error(fmt::format("{} is a checkpoint of format {}; this brume reads format {}", path,
                            header.format, kFormat));
  if (header.fingerprint_bytes > kLongestFingerprint) reader.fail("its header makes no sense");
  std::string text(header.fingerprint_bytes, '\0');
  reader.read({reinterpret_cast<unsigned char*>(text.data()), text.size()});
  reader.check_hash();
  return from_text(text);
}

}  // namespace

void write_checkpoint(const std::string& path, const Fingerprint& fingerprint,
                      const RenderState& state, Film& film) {
  const std::string text = to_text(fingerprint);
  const Header header{.fingerprint_bytes = text.size()};
  Summary summary{.state = state};
  if (const auto bad = film.bad_samples()) {
    summary.bad_samples = bad->count;
    summary.bad_x = bad->x;
    summary.bad_y = bad->y;
  }

  ByteHash hash;
  std::vector<Bytes> parts;
  const auto append = [&](Bytes bytes) {
    hash.add(bytes);
    parts.push_back(bytes);
  };
  append(bytes_of(header));
  append({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  const std::uint64_t header_hash = hash.value();
  append(bytes_of(header_hash));
  append(bytes_of(summary));
  for (const std::span<unsigned char> bytes : film.pixel_bytes()) append(bytes);
  const std::uint64_t whole_hash = hash.value();
  append(bytes_of(whole_hash));
  write_file_atomically(path, parts);
}

RenderState read_checkpoint(const std::string& path, const Fingerprint& fingerprint, Film& film) {
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
    throw Error(fmt::format("{} is a folder, not a checkpoint", path));
  Reader reader(path);
  const Fingerprint there = read_fingerprint(reader, path);
  if (const auto different = differences(there, fingerprint); !different.empty())
    throw Error(
        fmt::format("{} belongs to another render:\n  {}\n"
                    "Render what it belongs to, or remove it to render from the start",
                    path, fmt::join(different, "\n  ")));
  const Summary summary = reader.read<Summary>();
  for (const std::span<unsigned char> bytes : film.pixel_bytes()) reader.read(bytes);
  reader.check_hash();
  reader.check_end();
  if (summary.bad_samples > 0)
    film.set_bad_samples(
        BadSamples{.count = summary.bad_samples, .x = summary.bad_x, .y = summary.bad_y});
  return summary.state;
}

}  // namespace brume
