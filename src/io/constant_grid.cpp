// SPDX-License-Identifier: Apache-2.0
#include "io/constant_grid.h"

#include "io/grid_builder.h"

namespace brume {

AnyGrid make_constant_grid(const Rgb& value, const glm::dmat4& to_world) {
  VolFile voxel;
  voxel.resolution = glm::ivec3(1);
  const VolumeRequest request{.path = "constvolume", .to_world = to_world};
  Notices notices;  // a constant that the caller has checked gives none
  if (is_grey(value)) {
    voxel.values = {value.r};
    return build_grid<float>(voxel, request, notices);
  }
  voxel.channels = 3;
  voxel.values = {value.r, value.g, value.b};
  return build_grid<Rgb>(voxel, request, notices);
}

}  // namespace brume
