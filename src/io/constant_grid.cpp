// SPDX-License-Identifier: Apache-2.0
#include "io/constant_grid.h"

#include "io/grid_builder.h"

namespace brume {

AnyGrid make_constant_grid(const Rgb& value, const glm::dmat4& to_world) {
  const VolumeRequest request{.path = "constvolume", .to_world = to_world};
  Notices notices;  // a constant that the caller has checked gives none
  VolHeader voxel{.resolution = glm::ivec3(1)};
  if (is_grey(value)) {
    const auto layer = [&](int) { return std::vector{value.r}; };
    return build_grid<float>(voxel, layer, request, notices);
  }
  voxel.channels = 3;
  const auto layer = [&](int) { return std::vector{value.r, value.g, value.b}; };
  return build_grid<Rgb>(voxel, layer, request, notices);
}

}  // namespace brume
