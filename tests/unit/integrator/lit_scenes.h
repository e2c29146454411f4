// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "support/render_scene.h"
#include "support/scene_files.h"

namespace brume::test {

/// A scene with a camera within the room below; the camera does not matter to light.
inline TestScene lit_scene(const std::string& body) {
  return TestScene("<scene version=\"3.0.0\">" + body +
                   perspective("0.1, 0.2, 1.8", "0, -0.3, -1", 75, 6) + "</scene>");
}

inline std::string point_lamp(const std::string& position, const std::string& intensity) {
  return "<emitter type=\"point\"><point name=\"position\" value=\"" + position +
         "\"/><rgb name=\"intensity\" value=\"" + intensity + "\"/></emitter>";
}

/// Fog that fills the world.
inline std::string world_fog(const std::string& sigma_t, const std::string& albedo,
                             const std::string& g = "0.4") {
  return "<medium type=\"homogeneous\"><rgb name=\"sigma_t\" value=\"" + sigma_t +
         "\"/><rgb name=\"albedo\" value=\"" + albedo +
         "\"/><phase type=\"hg\"><float name=\"g\" value=\"" + g + "\"/></phase></medium>";
}

/// The cube [-2, 2]^3, seen from within.
inline const std::string kRoom = R"(
  <shape type="cube">
    <boolean name="flip_normals" value="true"/>
    <transform name="to_world"><scale value="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.5, 0.4"/></bsdf>
  </shape>)";

inline const std::string kAreaLamp = R"(
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="0.5"/><rotate x="1" angle="90"/><translate x="0.5" y="1.9"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="9, 8, 7"/></emitter>
  </shape>)";

inline const std::string kSpotLamp = R"(
  <emitter type="spot">
    <transform name="to_world">
      <lookat origin="-1, 1.5, 0.5" target="0, -2, 0" up="0, 0, 1"/>
    </transform>
    <rgb name="intensity" value="5, 6, 7"/><float name="cutoff_angle" value="40"/>
  </emitter>)";

inline const std::string kMetalBall = R"(
  <shape type="sphere"><point name="center" value="0.9, -1.2, -0.5"/>
    <float name="radius" value="0.7"/>
    <bsdf type="roughconductor"><float name="alpha" value="0.3"/></bsdf>
  </shape>)";

/// A room full of fog with one lamp of each kind.
inline const std::string kFoggyRoom = world_fog("0.3, 0.4, 0.5", "0.95, 0.9, 0.8") + kRoom +
                                      kMetalBall + kAreaLamp + kSpotLamp +
                                      point_lamp("1, 0.5, 1", "3, 2, 1");

}  // namespace brume::test
