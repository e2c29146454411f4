// SPDX-License-Identifier: Apache-2.0
// docs/scene-format.md and the code speak of the same things.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "scene_fixture.h"

namespace brume {
namespace {

using ::testing::HasSubstr;

class SceneFormatDoc : public test::SceneTest {
 public:
  static std::string document() {
    std::ifstream file(std::filesystem::path(BRUME_SOURCE_DIR) / "docs/scene-format.md");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

  // The words of `message` after `marker`.
  static std::vector<std::string> list_after(const std::string& message,
                                             const std::string& marker) {
    std::string rest =
        message.substr(std::min(message.find(marker) + marker.size(), message.size()));
    std::replace(rest.begin(), rest.end(), ',', ' ');
    std::stringstream words(rest);
    std::vector<std::string> result;
    for (std::string word; words >> word;) result.push_back(word);
    return result;
  }
};

TEST_F(SceneFormatDoc, NamesEveryPlugin) {
  const std::string doc = document();
  ASSERT_FALSE(doc.empty());
  const char* bodies[] = {
      R"(<integrator type="?"/>)",
      R"(<emitter type="?"/>)",
      R"(<shape type="?"/>)",
      R"(<shape type="disk"><bsdf type="?"/></shape>)",
      R"(<shape type="disk"><bsdf type="diffuse"><texture name="reflectance" type="?"/></bsdf></shape>)",
      R"(<medium type="?"/>)",
      R"(<medium type="homogeneous"><phase type="?"/></medium>)",
      R"(<medium type="heterogeneous"><volume name="albedo" type="?"/></medium>)",
      R"(<sensor type="?"/>)",
      R"(<sensor type="perspective"><sampler type="?"/></sensor>)",
      R"(<sensor type="perspective"><film type="?"/></sensor>)",
      R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="?"/></film></sensor>)",
  };
  for (const char* body : bodies) {
    const auto plugins = list_after(error_line(with_sensor(body)), "Supported:");
    EXPECT_FALSE(plugins.empty()) << body;
    for (const std::string& plugin : plugins) {
      EXPECT_THAT(doc, HasSubstr("`" + plugin + "`")) << "from " << body;
    }
  }
}

// Each unknown parameter is answered with the list of those that are valid.
TEST_F(SceneFormatDoc, NamesEveryParameter) {
  const std::string doc = document();
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file = R"(<string name="filename" value="m.obj"/>)";
  const std::string unknown = R"(<float name="qqqqqq" value="1"/>)";
  std::vector<std::string> bodies = {
      R"(<integrator type="volpath">)" + unknown + "</integrator>",
      R"(<integrator type="volpathmis">)" + unknown + "</integrator>",
      R"(<sensor type="perspective">)" + unknown + "</sensor>",
      R"(<sensor type="orthographic">)" + unknown + "</sensor>",
      R"(<sensor type="thinlens"><float name="aperture_radius" value="1"/>)" + unknown +
          "</sensor>",
      R"(<sensor type="perspective"><sampler type="independent">)" + unknown +
          "</sampler></sensor>",
      R"(<sensor type="perspective"><film type="hdrfilm">)" + unknown + "</film></sensor>",
      R"(<medium type="homogeneous">)" + unknown + "</medium>",
      R"(<medium type="heterogeneous">)" + unknown + "</medium>",
      R"(<medium type="homogeneous"><phase type="hg">)" + unknown + "</phase></medium>",
      R"(<medium type="heterogeneous"><volume type="constvolume" name="albedo">)"
      R"(<float name="value" value="1"/>)" +
          unknown + "</volume></medium>",
      R"(<shape type="obj">)" + file + unknown + "</shape>",
  };
  for (const char* type : {"box", "tent", "gaussian"}) {
    bodies.push_back(
        std::string(R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type=")") + type +
        "\">" + unknown + "</rfilter></film></sensor>");
  }
  for (const char* type : {"sphere", "rectangle", "cube", "disk", "cylinder"}) {
    bodies.push_back(std::string("<shape type=\"") + type + "\">" + unknown + "</shape>");
  }
  for (const char* type : {"point", "spot", "directional", "constant"}) {
    bodies.push_back(std::string("<emitter type=\"") + type + "\">" + unknown + "</emitter>");
  }
  for (const char* type : {"diffuse", "dielectric", "thindielectric", "roughdielectric",
                           "conductor", "roughconductor", "plastic", "roughplastic"}) {
    bodies.push_back(std::string("<shape type=\"disk\"><bsdf type=\"") + type + "\">" + unknown +
                     "</bsdf></shape>");
  }
  for (const std::string& body : bodies) {
    const auto parameters = list_after(error_line(with_sensor(body)), "expected one of");
    EXPECT_FALSE(parameters.empty()) << body << "\n" << error_line(with_sensor(body));
    for (const std::string& parameter : parameters) {
      EXPECT_THAT(doc, HasSubstr("`" + parameter + "`")) << "from " << body;
    }
  }
}

}  // namespace
}  // namespace brume
