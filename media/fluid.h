// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dense_grid.h"

namespace brume::media {

/// A small solver for hot smoke: an incompressible fluid on a staggered grid with a solid floor and
/// open sides and top. Lengths are in voxels, times in steps; cell i spans [i, i + 1].
class Fluid {
 public:
  explicit Fluid(const glm::ivec3& size);

  /// What the fluid carries, at cell centres: the densities of two smokes, and the temperature.
  DenseGrid<glm::vec3>& carried() { return carried_; }

  /// Adds `acceleration` [voxels/step^2] in proportion to temperature less the weight of the smoke,
  /// restores small whirls (Fedkiw et al. 2001, eq. 11), makes the flow free of divergence and
  /// moves everything along by one step (MacCormack: Selle et al. 2008).
  void step(float acceleration, float smoke_weight, float whirl);

 private:
  using Vec3f = glm::vec3;

  void add_buoyancy(float acceleration, float smoke_weight);
  void add_whirls(float strength);
  void project();
  void move();
  Vec3f center_velocity(int x, int y, int z) const;

  glm::ivec3 size_;
  DenseGrid<float> u_, v_, w_;  // velocity through the faces whose normal is x, y, z [voxels/step]
  DenseGrid<float> pressure_;
  DenseGrid<Vec3f> carried_;
};

}  // namespace brume::media
