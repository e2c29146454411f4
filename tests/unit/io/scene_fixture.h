// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "io/scene_file.h"
#include "support/notices.h"

namespace brume::test {

/// A folder of its own for the files of one test, removed afterwards.
class SceneTest : public ::testing::Test {
 public:
  SceneTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    for (char& c : name) c = c == '/' ? '.' : c;
    folder_ = std::filesystem::path(::testing::TempDir()) / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SceneTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  LoadedScene load(const std::string& text, const Definitions& definitions = {}) {
    notices_ = {};
    return load_scene(write("scene.xml", text), definitions, notices_);
  }
  /// A scene of today's dialect around `body`, with a default sensor.
  LoadedScene load_body(const std::string& body) { return load(with_sensor(body)); }

  static std::string with_sensor(const std::string& body) {
    return "<scene version=\"3.0.0\">\n" + body + "\n<sensor type=\"perspective\"/></scene>";
  }
  static std::string old_dialect(const std::string& body) {
    return "<scene version=\"0.6.0\">\n" + body + "\n<sensor type=\"perspective\"/></scene>";
  }

  /// The message that loading `text` ends with, without the test's folder (HERE where that stands
  /// alone); empty if it loads.
  std::string error(const std::string& text, const Definitions& definitions = {}) {
    try {
      load(text, definitions);
    } catch (const Error& e) {
      std::string message = e.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) {
        message.erase(at, prefix.size());
      }
      if (const std::size_t at = message.find(folder_.string()); at != std::string::npos) {
        message.replace(at, folder_.string().size(), "HERE");
      }
      return message;
    }
    return {};
  }
  /// Its first line.
  std::string error_line(const std::string& text, const Definitions& definitions = {}) {
    const std::string message = error(text, definitions);
    return message.substr(0, message.find('\n'));
  }

  const std::filesystem::path& folder() const { return folder_; }
  std::vector<std::string> notices() const { return in_words(notices_); }

 private:
  std::filesystem::path folder_;
  Notices notices_;
};

}  // namespace brume::test
