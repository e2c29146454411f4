// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell.h"
#include "scene_text.h"
#include "support/scene_files.h"

// Cameras exactly on faces, edges and corners of a medium's box, looking along axes, diagonals and
// faces. Whether the face itself belongs to the medium is open; anything else is known.

namespace brume::test {

std::vector<Cell> cells_of_views() {
  struct Sight {
    const char* name;
    glm::dvec3 origin, d;
    double length;  // of the ray inside the box; negative: runs in a face, anything goes
  };
  const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0);
  const Sight sights[] = {
      {"FaceInward", {0.5, 0.5, 0}, {0, 0, 1}, 1},
      {"FaceOutward", {0.5, 0.5, 0}, {0, 0, -1}, 0},
      {"FaceAslant", {0.5, 0.5, 0}, {0, 1, 1}, root2 / 2},
      {"FarFaceInward", {0.5, 0.5, 1}, {0, 0, -1}, 1},
      {"FarFaceOutward", {0.5, 0.5, 1}, {0, 0, 1}, 0},
      {"InFace", {0.5, 0.5, 0}, {1, 0, 0}, -1},
      {"InFarFace", {0.5, 0.5, 1}, {-1, 0, 0}, -1},
      {"EdgeInward", {0, 0, 0.5}, {1, 1, 0}, root2},
      {"EdgeOutward", {0, 0, 0.5}, {-1, -1, 0}, 0},
      {"EdgeAlong", {0, 0, 0.5}, {0, 0, 1}, -1},
      {"CornerDiagonal", {0, 0, 0}, {1, 1, 1}, root3},
      {"CornerOutward", {0, 0, 0}, {-1, -1, -1}, 0},
      {"CornerFaceDiagonal", {0, 0, 0}, {1, 1, 0}, -1},
      {"CornerEdge", {0, 0, 0}, {1, 0, 0}, -1},
      {"FarCornerDiagonal", {1, 1, 1}, {-1, -1, -1}, root3},
      {"OutsideAlongAxis", {-1, 0.5, 0.5}, {1, 0, 0}, 1},
      {"OutsideAgainstAxis", {2, 0.5, 0.5}, {-1, 0, 0}, 1},
      {"OutsideDiagonal", {-1, -1, -1}, {1, 1, 1}, root3},
      {"OutsideAgainstDiagonal", {2, 2, 2}, {-1, -1, -1}, root3},
      {"OutsideEdgeDiagonal", {-1, -1, 0.5}, {1, 1, 0}, root2},
      {"OutsideInFace", {-1, 0.5, 0}, {1, 0, 0}, -1},
      {"OutsideInEdge", {-1, 0, 0}, {1, 0, 0}, -1},
      {"BetweenVoxels", {-1, 0.25, 0.5}, {1, 0, 0}, 1},
      {"Past", {-1, 1.0001, 0.5}, {1, 0, 0}, 0},
  };
  const glm::dvec3 lo(0.0), hi(1.0);
  const auto write_files = [](const TemporaryFolder& folder) {
    folder.write("grid.vol", vol_bytes(glm::ivec3(8), 1, [](int, int, int, int) { return 1; }));
  };
  std::vector<Cell> cells;
  for (const Sight& s : sights) {
    for (const bool is_grid : {false, true}) {
      for (const double albedo : {0.0, 1.0}) {
        const std::string medium =
            is_grid
                ? heterogeneous(vol_volume("grid.vol", lo, hi), 1.0, fmt::format("{}", albedo), 0)
                : cube(lo, hi, kNull + homogeneous(1, albedo, 0, "interior"));
        std::optional<glm::dvec3> want;
        if (albedo == 1.0)
          want = glm::dvec3(1.0);
        else if (s.length >= 0.0)
          want = glm::dvec3(std::exp(-s.length));
        cells.push_back(
            {.axis = albedo == 0.0 ? "view, Beer-Lambert" : "view, furnace",
             .at = 1,
             .name = fmt::format("{}{}Albedo{:.0f}", s.name, is_grid ? "Grid" : "Hull", albedo),
             .scene = scene(camera({.origin = s.origin,
                                    .target = s.origin + s.d,
                                    .near = 1e-30,
                                    .up = {0.3, -0.2, 0.1}}) +
                            medium + environment()),
             .write_files = write_files,
             .central_ray = true,
             .want = want});
      }
    }
  }
  return cells;
}

}  // namespace brume::test
