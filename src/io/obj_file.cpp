// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "core/error.h"
#include "io/mesh_file.h"
#include "io/number_text.h"
#include "io/source_file.h"

namespace brume {
namespace {

// The corner of a face: positions in the lists v, vt, vn; -1 where there is none.
using Corner = std::array<std::int64_t, 3>;

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& path)
      : path_(path), text_(read_whole_file(path)) {}

  MeshData read() {
    for (std::size_t at = 0; at < text_.size();) read_statement(next_line(at));
    if (mesh_.indices.empty()) throw Error(fmt::format("{}: holds no face", path_.string()));
    if (!all_have_uv_) mesh_.uvs.clear();
    if (!all_have_normal_) mesh_.normals.clear();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(fmt::format("{}:{}: {}", path_.string(), line_, message));
  }

  // The line from `at` on, joined with the next where it ends in a backslash.
  std::string next_line(std::size_t& at) {
    std::string line;
    bool continues = true;
    while (continues && at < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      std::string_view part(text_.data() + at, end - at);
      if (part.ends_with('\r')) part.remove_suffix(1);
      continues = part.ends_with('\\');
      if (continues) part.remove_suffix(1);
      line.append(part).push_back(' ');
      at = end + 1;
      ++line_;
    }
    return line;
  }

  void read_statement(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::vector<std::string_view> words = split_words(line);
    if (words.empty()) return;
    if (words[0] == "v") {
      positions_.push_back(numbers(words, 3));
    } else if (words[0] == "vt") {
      uvs_.push_back(Vec2(numbers(words, 1)));
    } else if (words[0] == "vn") {
      normals_.push_back(numbers(words, 3));
    } else if (words[0] == "f") {
      read_face(words);
    }
  }

  // Up to three numbers, of which `required` must be there; further ones are skipped.
  Vec3 numbers(const std::vector<std::string_view>& words, std::size_t required) const {
    if (words.size() - 1 < required) {
      fail(fmt::format("\"{}\" needs {} numbers, found {}", words[0], required, words.size() - 1));
    }
    Vec3 result{0.0f};
    for (std::size_t i = 0; i < 3 && i + 1 < words.size(); ++i) {
      const auto value = parse_number(words[i + 1]);
      if (!value || !std::isfinite(float(*value))) {
        fail(fmt::format("\"{}\" is not a finite number", words[i + 1]));
      }
      result[int(i)] = float(*value);
    }
    return result;
  }

  void read_face(const std::vector<std::string_view>& words) {
    if (words.size() < 4) {
      fail(fmt::format("a face needs 3 corners, found {}", words.size() - 1));
    }
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 1; i < words.size(); ++i) polygon.push_back(vertex(corner(words[i])));
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      mesh_.indices.insert(mesh_.indices.end(), {polygon[0], polygon[i - 1], polygon[i]});
    }
  }

  // v, v/vt, v//vn or v/vt/vn
  Corner corner(std::string_view word) const {
    const std::string whole(word);
    const std::size_t sizes[] = {positions_.size(), uvs_.size(), normals_.size()};
    constexpr std::string_view kNames[] = {"vertices", "texture coordinates", "normals"};
    Corner result{-1, -1, -1};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t slash = word.find('/');
      const std::string_view part = word.substr(0, slash);
      if (!part.empty()) {
        const auto index = parse_integer(part);
        if (!index) fail(fmt::format("\"{}\" is not the corner of a face", whole));
        const auto size = std::int64_t(sizes[i]);
        // Negative indices count back from the last.
        result[i] = *index < 0 ? size + *index : *index - 1;
        if (result[i] < 0 || result[i] >= size) {
          fail(fmt::format("index {} is out of range: {} {} so far", *index, size, kNames[i]));
        }
      } else if (i == 0) {
        fail(fmt::format("\"{}\" is not the corner of a face", whole));
      }
      if (slash == std::string_view::npos) return result;
      word.remove_prefix(slash + 1);
    }
    fail(fmt::format("\"{}\" is not the corner of a face", whole));
  }

  std::uint32_t vertex(const Corner& corner) {
    const auto [known, is_new] = vertices_.emplace(corner, std::uint32_t(mesh_.positions.size()));
    if (is_new) {
      all_have_uv_ = all_have_uv_ && corner[1] >= 0;
      all_have_normal_ = all_have_normal_ && corner[2] >= 0;
      mesh_.positions.push_back(positions_[std::size_t(corner[0])]);
      mesh_.uvs.push_back(corner[1] >= 0 ? uvs_[std::size_t(corner[1])] : Vec2(0.0f));
      mesh_.normals.push_back(corner[2] >= 0 ? normals_[std::size_t(corner[2])] : Vec3(0.0f));
    }
    return known->second;
  }

  std::filesystem::path path_;
  std::string text_;
  int line_ = 0;
  std::vector<Vec3> positions_, normals_;
  std::vector<Vec2> uvs_;
  std::map<Corner, std::uint32_t> vertices_;
  bool all_have_uv_ = true, all_have_normal_ = true;
  MeshData mesh_;
};

}  // namespace

MeshData read_obj(const std::filesystem::path& path) {
  return ObjReader(path).read();
}

}  // namespace brume
