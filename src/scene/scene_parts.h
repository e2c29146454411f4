// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/shape.h"
#include "light/environment_light.h"
#include "light/light.h"
#include "material/bsdf.h"
#include "medium/medium.h"

namespace brume {

/// A shape with everything that happens at it.
struct Surface {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Bsdf> bsdf;
  std::optional<Rgb> radiance{};  // emitted from the outside [W/(m^2 sr)]; none: not a light
  bool is_boundary = false;       // whether crossing the surface changes the medium
  std::shared_ptr<const Medium> interior{}, exterior{};  // null is vacuum; used if is_boundary
};

/// What a scene is made of, before it is put in order for rendering.
struct SceneParts {
  std::vector<Surface> surfaces;
  std::vector<std::shared_ptr<const Light>> lights;  // point, spot, directional
  std::vector<std::shared_ptr<const EnvironmentLight>> environments;
  std::shared_ptr<const Medium> world_medium;  // outside all shapes; null is vacuum
};

}  // namespace brume
