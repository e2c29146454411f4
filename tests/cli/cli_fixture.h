// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/picture_file.h"
#include "cli/program.h"
#include "support/temporary_folder.h"

namespace brume::test {

/// Runs brume in a folder with a small scene, scene.xml: a glass ball in a ball of fog, lit by a
/// constant sky, 16 x 12 pixels, 4 samples.
class CliTest : public ::testing::Test {
 protected:
  CliTest() { write("scene.xml", kScene); }

  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  void write(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
  }

  std::string bytes(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(bytes(name)); }
  PictureFile read(const std::string& name) const { return read_picture(path(name)); }

  Ended run(std::vector<std::string> arguments) const {
    return run_brume({.arguments = std::move(arguments), .folder = folder_.path()});
  }
  Ended run_on_terminal(std::vector<std::string> arguments) const {
    return run_brume({.arguments = std::move(arguments),
                      .folder = folder_.path(),
                      .stderr_is = ErrorStream::kTerminal});
  }

  /// The run ends with `exit_code`, writes no picture and nothing to stdout, and this to stderr.
  void expect_refusal(std::vector<std::string> arguments, int exit_code,
                      const std::string& message) const {
    const Ended ended = run(std::move(arguments));
    EXPECT_EQ(ended.exit_code, exit_code);
    EXPECT_EQ(ended.err, message);
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(exists("scene.exr"));
  }

  static constexpr const char* kScene = R"(<scene version="3.0.0">
  <default name="glow" value="1"/>
  <sensor type="perspective">
    <float name="fov" value="40"/>
    <transform name="to_world">
      <lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/>
    </transform>
    <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="16"/>
      <integer name="height" value="12"/>
    </film>
  </sensor>
  <medium type="homogeneous" id="fog"><float name="sigma_t" value="2"/></medium>
  <shape type="sphere">
    <bsdf type="null"/>
    <ref name="interior" id="fog"/>
  </shape>
  <shape type="sphere">
    <float name="radius" value="0.5"/>
    <bsdf type="dielectric"/>
    <ref name="exterior" id="fog"/>
  </shape>
  <emitter type="constant"><float name="radiance" value="$glow"/></emitter>
</scene>
)";

 private:
  TemporaryFolder folder_;
};

}  // namespace brume::test
