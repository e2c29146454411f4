// SPDX-License-Identifier: Apache-2.0
#include "app/render_fingerprint.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "app/version.h"
#include "core/byte_hash.h"
#include "core/error.h"

namespace brume {
namespace {

/// Size and hash of a file in words.
std::string content_in_words(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr)
    throw Error(fmt::format("{}: {}", path.string(), std::strerror(errno)),
                ErrorKind::kEnvironment);
  ByteHash hash;
  std::uint64_t size = 0;
  std::vector<unsigned char> block(1 << 20);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    hash.add({block.data(), count});
    size += count;
  }
  if (std::ferror(file.get()) != 0)
    throw Error(fmt::format("{}: {}", path.string(), std::strerror(errno)),
                ErrorKind::kEnvironment);
  return fmt::format("{} bytes of hash {:016x}", size, hash.value());
}

std::string in_words(const Rgb& c) {
  return fmt::format("{},{},{}", c.r, c.g, c.b);
}

}  // namespace

Fingerprint render_fingerprint(const RenderOptions& options, const LoadedScene& loaded,
                               const FilmLayers& layers) {
  Fingerprint result = {
      {"version of brume", kVersion},
      {"--seed", std::to_string(options.seed)},
      {"size of the picture",
       fmt::format("{}x{}", loaded.film.crop_size.x, loaded.film.crop_size.y)},
      {"layers", fmt::format("{}{}", layers.albedo ? "albedo " : "", layers.depth ? "depth" : "")},
      {"maximum depth", std::to_string(loaded.path.max_depth)},
  };
  const std::filesystem::path folder = loaded.files.front().parent_path();
  for (const std::filesystem::path& file : loaded.files)
    result.emplace_back("content of " + file.lexically_relative(folder).string(),
                        content_in_words(file));
  for (const auto& [name, value] : options.definitions) result.emplace_back("-D " + name, value);
  for (const auto& [name, value] : changed_settings(options.settings))
    result.emplace_back("--set " + name, value);
  if (!options.grid.empty()) result.emplace_back("--grid", options.grid);
  if (options.density_scale)
    result.emplace_back("--density-scale", fmt::format("{}", *options.density_scale));
  if (options.albedo) result.emplace_back("--albedo", in_words(*options.albedo));
  if (options.g) result.emplace_back("--g", fmt::format("{}", *options.g));
  return result;
}

}  // namespace brume
