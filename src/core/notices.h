// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace brume {

/// What a person is told although it is no error.
struct Notice {
  bool is_warning;
  std::string text;
};

/// In order of discovery.
class Notices {
 public:
  /// Something was chosen that nobody had asked for.
  void note(std::string text) { all_.push_back({false, std::move(text)}); }
  /// Something in the input was clamped, converted, ignored or unclear.
  void warn(std::string text) { all_.push_back({true, std::move(text)}); }

  const std::vector<Notice>& all() const { return all_; }

 private:
  std::vector<Notice> all_;
};

}  // namespace brume
