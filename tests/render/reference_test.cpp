// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "core/error.h"
#include "render/reference_scenes.h"
#include "support/render_scene.h"

namespace brume::test {
namespace {

class TwoIntegrators : public ::testing::TestWithParam<ReferenceScene> {};

TEST_P(TwoIntegrators, SeeTheSameLight) {
  const TestScene scene(GetParam().xml, write_reference_files);
  const Rendered path = render_path(scene, 64);
  const Rendered reference = render_reference(scene, GetParam().replications);
  expect_same_picture(path, reference, 2, {kRed, kGreen, kBlue});

  // The comparison says something: the picture is bright and known to a percent.
  const RunningMean green = reference.whole(kGreen);
  EXPECT_GT(green.mean(), 0.05);
  EXPECT_LT(green.standard_error(), 0.01 * green.mean());
}

INSTANTIATE_TEST_SUITE_P(, TwoIntegrators, ::testing::ValuesIn(reference_scenes()),
                         [](const ::testing::TestParamInfo<ReferenceScene>& c) {
                           return c.param.name;
                         });

/// The types of <tag type="..."> in a scene, by tag.
void collect_types(const std::string& xml, std::map<std::string, std::set<std::string>>& types) {
  const std::regex element("<([a-z]+)[^>]* type=\"([a-z]+)\"");
  for (std::sregex_iterator i(xml.begin(), xml.end(), element), end; i != end; ++i)
    types[(*i)[1]].insert((*i)[2]);
}

/// The types that the scene language has for the objects among which `xml` names one that does not
/// exist: the message of the error lists them.
std::set<std::string> supported_types(const std::string& xml) {
  try {
    TestScene scene("<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" + xml + "</scene>");
  } catch (const Error& error) {
    const std::string message = error.what();
    const std::string begin = "Supported: ";
    const auto at = message.find(begin);
    if (at == std::string::npos) return {message};
    std::set<std::string> types;
    std::istringstream line(message.substr(at + begin.size()));
    for (std::string type; line >> type;) {
      const bool last = type.back() != ',';
      if (!last) type.pop_back();
      types.insert(type);
      if (last) break;
    }
    return types;
  }
  return {"no error"};
}

TEST(ReferenceScenes, UseEveryMediumMaterialAndLightOfTheSceneLanguage) {
  std::map<std::string, std::set<std::string>> used;
  for (const ReferenceScene& scene : reference_scenes()) collect_types(scene.xml, used);

  const std::string medium = "<medium type=\"heterogeneous\">";
  const std::map<std::string, std::string> nonexistent = {
      {"medium", "<medium type=\"none\"/>"},
      {"phase", medium + "<phase type=\"none\"/></medium>"},
      {"volume", medium + "<volume name=\"sigma_t\" type=\"none\"/></medium>"},
      {"bsdf", "<shape type=\"sphere\"><bsdf type=\"none\"/></shape>"},
      {"texture",
       "<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" "
       "type=\"none\"/></bsdf></shape>"},
      {"emitter", "<emitter type=\"none\"/>"},
      {"shape", "<shape type=\"none\"/>"},
      {"integrator", "<integrator type=\"none\"/>"},
  };
  for (const auto& [tag, xml] : nonexistent) {
    const std::set<std::string> supported = supported_types(xml);
    EXPECT_GE(supported.size(), 2u) << tag;
    EXPECT_THAT(used[tag], ::testing::IsSupersetOf(supported)) << tag;
  }
}

TEST(ReferenceScenes, MeetLightPathsInSomeAndNoneInOthers) {
  std::set<std::string> meet;
  for (const ReferenceScene& reference : reference_scenes()) {
    const TestScene scene(reference.xml, write_reference_files);
    const LoadedScene& loaded = scene.loaded();
    if (PathIntegrator(*loaded.scene, *loaded.camera, loaded.path).meets_light_paths())
      meet.insert(reference.name);
  }
  EXPECT_THAT(meet, ::testing::IsSupersetOf({"FoggyRoom", "LampsInFog", "ManyLights"}));
  EXPECT_LT(meet.size(), reference_scenes().size());
}

}  // namespace
}  // namespace brume::test
