// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "io/mesh_file.h"
#include "io/number_text.h"
#include "io/source_file.h"

namespace brume {
namespace {

enum class Format { kAscii, kLittleEndian, kBigEndian };
enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

constexpr std::array<std::size_t, 8> kTypeSize = {1, 1, 2, 2, 4, 4, 4, 8};

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count_type;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

std::optional<Type> type_named(std::string_view name) {
  constexpr std::array<std::string_view, 8> kOld = {"char", "uchar", "short", "ushort",
                                                    "int",  "uint",  "float", "double"};
  constexpr std::array<std::string_view, 8> kNew = {"int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "float32", "float64"};
  for (std::size_t i = 0; i < kOld.size(); ++i) {
    if (name == kOld[i] || name == kNew[i]) return Type(i);
  }
  return std::nullopt;
}

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& path)
      : path_(path), text_(read_whole_file(path)) {}

  MeshData read() {
    read_header();
    for (const Element& element : elements_) read_element(element);
    check_indices();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(fmt::format("{}: {}", path_.string(), message));
  }
  [[noreturn]] void fail_line(const std::string& message) const {
    throw Error(fmt::format("{}:{}: {}", path_.string(), line_, message));
  }

  std::string_view next_line() {
    if (at_ >= text_.size()) fail("ends in the middle of the PLY header");
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line(text_.data() + at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    ++line_;
    return line;
  }

  void read_header() {
    if (!text_.starts_with("ply") || next_line() != "ply") {
      fail("is not a PLY file: it does not begin with \"ply\"");
    }
    bool has_format = false;
    while (true) {
      const std::vector<std::string_view> words = split_words(next_line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() == 3) {
        read_format(words[1]);
        has_format = true;
      } else if (words[0] == "element" && words.size() == 3) {
        const auto count = parse_integer(words[2]);
        if (!count || *count < 0) fail_line(fmt::format("\"{}\" is not a count", words[2]));
        elements_.push_back({std::string(words[1]), std::uint64_t(*count), {}});
      } else if (words[0] == "property" && words.size() >= 3 && !elements_.empty()) {
        read_property(words);
      } else {
        fail_line(fmt::format("\"{}\" does not belong in a PLY header", words[0]));
      }
    }
    if (!has_format) fail("the PLY header names no format");
    ++line_;
  }

  void read_format(std::string_view name) {
    if (name == "ascii") {
      format_ = Format::kAscii;
    } else if (name == "binary_little_endian") {
      format_ = Format::kLittleEndian;
    } else if (name == "binary_big_endian") {
      format_ = Format::kBigEndian;
    } else {
      fail_line(fmt::format("unknown PLY format \"{}\"", name));
    }
  }

  void read_property(const std::vector<std::string_view>& words) {
    const auto type_of = [this](std::string_view name) {
      if (const auto type = type_named(name)) return *type;
      fail_line(fmt::format("unknown PLY type \"{}\"", name));
    };
    Property property{.name = std::string(words.back()), .type = Type::kInt8, .count_type = {}};
    if (words[1] == "list" && words.size() == 5) {
      property.count_type = type_of(words[2]);
      property.type = type_of(words[3]);
    } else if (words.size() == 3) {
      property.type = type_of(words[1]);
    } else {
      fail_line("a property is \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
    }
    elements_.back().properties.push_back(std::move(property));
  }

  // Fewest bytes that one value takes in this file.
  std::size_t least_bytes(Type type) const {
    return format_ == Format::kAscii ? 2 : kTypeSize[std::size_t(type)];
  }

  // Throws unless the rest of the file can hold `count` things of `bytes` each, so that a wrong
  // count never makes us allocate what is not there. (The last blank of a text may be missing.)
  void check_room(std::uint64_t count, std::size_t bytes, std::string_view what) const {
    const std::size_t rest = (at_ < text_.size() ? text_.size() - at_ : 0) + 1;
    if (bytes > 0 && count > rest / bytes) {
      fail(fmt::format("ends too early: {} {} need at least {} bytes each, {} bytes are left",
                       count, what, bytes, rest - 1));
    }
  }

  double next_value(Type type) { return format_ == Format::kAscii ? text_value() : binary(type); }

  double text_value() {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t start = text_.find_first_not_of(kBlanks, std::min(at_, text_.size()));
    if (start == std::string::npos) fail("ends in the middle of its numbers");
    line_ += int(std::count(text_.begin() + std::ptrdiff_t(at_),
                            text_.begin() + std::ptrdiff_t(start), '\n'));
    at_ = std::min(text_.find_first_of(kBlanks, start), text_.size());
    const std::string_view word = std::string_view(text_).substr(start, at_ - start);
    // An infinite or NaN value matters only where it is used, and is refused there.
    if (word == "nan" || word == "inf" || word == "-nan" || word == "-inf") return NAN;
    const auto value = parse_number(word);
    if (!value) fail_line(fmt::format("\"{}\" is not a number", word));
    return *value;
  }

  template <class T>
  double raw() {
    if (text_.size() - std::min(at_, text_.size()) < sizeof(T)) {
      fail("ends in the middle of its data");
    }
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if ((format_ == Format::kBigEndian) != (std::endian::native == std::endian::big)) {
      std::reverse(bytes.begin(), bytes.end());
    }
    return double(std::bit_cast<T>(bytes));
  }

  double binary(Type type) {
    switch (type) {
      case Type::kInt8:
        return raw<std::int8_t>();
      case Type::kUint8:
        return raw<std::uint8_t>();
      case Type::kInt16:
        return raw<std::int16_t>();
      case Type::kUint16:
        return raw<std::uint16_t>();
      case Type::kInt32:
        return raw<std::int32_t>();
      case Type::kUint32:
        return raw<std::uint32_t>();
      case Type::kFloat32:
        return raw<float>();
      case Type::kFloat64:
        return raw<double>();
    }
    return 0.0;
  }

  std::vector<double> next_list(const Property& property) {
    const double count = next_value(*property.count_type);
    if (!(count >= 0.0) || count != std::floor(count)) {
      fail(fmt::format("a list of \"{}\" has {} entries", property.name, count));
    }
    const std::uint64_t n = std::uint64_t(std::min(count, 1e18));
    check_room(n, least_bytes(property.type), fmt::format("entries of \"{}\"", property.name));
    std::vector<double> values(n);
    for (double& v : values) v = next_value(property.type);
    return values;
  }

  void read_element(const Element& element) {
    std::size_t bytes = 0;
    for (const Property& p : element.properties) {
      bytes += least_bytes(p.count_type ? *p.count_type : p.type);
    }
    check_room(element.count, bytes, fmt::format("\"{}\"", element.name));
    if (element.properties.empty()) return;
    if (element.name == "vertex") {
      read_vertices(element);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) read_other(element);
    }
  }

  void read_vertices(const Element& element) {
    const auto& properties = element.properties;
    const auto column = [&](std::initializer_list<std::string_view> names) {
      for (std::size_t i = 0; i < properties.size(); ++i) {
        const bool is_named =
            std::find(names.begin(), names.end(), properties[i].name) != names.end();
        if (is_named && !properties[i].count_type) return int(i);
      }
      return -1;
    };
    const int x = column({"x"}), y = column({"y"}), z = column({"z"});
    if (x < 0 || y < 0 || z < 0) fail("its vertices have no x, y and z");
    const int nx = column({"nx"}), ny = column({"ny"}), nz = column({"nz"});
    const int u = column({"u", "s", "texture_u"}), v = column({"v", "t", "texture_v"});

    std::vector<float> row(properties.size());
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t j = 0; j < properties.size(); ++j) {
        if (properties[j].count_type) {
          next_list(properties[j]);
        } else {
          row[j] = float(next_value(properties[j].type));
        }
      }
      const auto value = [&](int index) {
        if (!std::isfinite(row[std::size_t(index)])) {
          fail(fmt::format("vertex {} has a \"{}\" that is not finite", i,
                           properties[std::size_t(index)].name));
        }
        return row[std::size_t(index)];
      };
      mesh_.positions.emplace_back(value(x), value(y), value(z));
      if (nx >= 0 && ny >= 0 && nz >= 0)
        mesh_.normals.emplace_back(value(nx), value(ny), value(nz));
      if (u >= 0 && v >= 0) mesh_.uvs.emplace_back(value(u), value(v));
    }
  }

  void read_other(const Element& element) {
    for (const Property& p : element.properties) {
      if (!p.count_type) {
        next_value(p.type);
        continue;
      }
      const std::vector<double> list = next_list(p);
      const bool is_face =
          element.name == "face" && (p.name == "vertex_index" || p.name == "vertex_indices");
      if (!is_face) continue;
      if (list.size() < 3) fail(fmt::format("a face has {} corners", list.size()));
      for (std::size_t i = 2; i < list.size(); ++i) {
        for (const double index : {list[0], list[i - 1], list[i]}) add_index(index);
      }
    }
  }

  void add_index(double index) {
    if (!(index >= 0.0) || index > 4294967295.0 || index != std::floor(index)) {
      fail(fmt::format("a face has the vertex index {}", index));
    }
    mesh_.indices.push_back(std::uint32_t(index));
  }

  void check_indices() const {
    if (mesh_.indices.empty()) fail("holds no face");
    const std::uint32_t largest = *std::max_element(mesh_.indices.begin(), mesh_.indices.end());
    if (largest >= mesh_.positions.size()) {
      fail(fmt::format("a face has the vertex index {}, but there are {} vertices", largest,
                       mesh_.positions.size()));
    }
  }

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;  // [bytes] read so far
  int line_ = 0;        // that `at_` follows in the header, and stands in afterwards
  Format format_ = Format::kAscii;
  std::vector<Element> elements_;
  MeshData mesh_;
};

}  // namespace

MeshData read_ply(const std::filesystem::path& path) {
  return PlyReader(path).read();
}

}  // namespace brume
