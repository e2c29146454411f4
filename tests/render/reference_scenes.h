// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace brume::test {

/// A small scene that both integrators render, with lights large enough to run into. Lights that
/// cannot be run into stand outside media: scatterings beside them would see them arbitrarily
/// bright, and the means of the reference would not settle.
///
///   name            media                      materials                    lights
///   FoggyRoom       fills the world, hg        diffuse, plastic,            area (rectangle)
///                                              roughplastic, textures
///   GlassInFog      hull, absorbing glass      dielectric, roughdielectric, envmap
///                                              thindielectric
///   MetalsInSmoke   vdb, albedo from a grid    conductor, roughconductor,   area (sphere) in the
///                                              twosided                     medium, constant
///   SmallLights     coloured grid in a hull    diffuse, roughplastic        point, spot,
///                                                                           directional
///   CloudInFog      nested, camera inside,     null, diffuse                area (mesh), constant
///                   backward, constvolume
///   StraightOrBack  g = 1 and g = -1           null, dielectric             constant, area (disk)
///   ShortPaths      homogeneous, max_depth 3   diffuse, roughconductor      area (tube), constant
///   LampsInFog      fills the world, coloured  null, diffuse                point, spot, each in a
///                                                                           bubble; area (sphere)
///   ManyLights      fills the world, coloured  diffuse                      area (64 spheres)
///   AllLights       homogeneous, coloured      diffuse, plastic             all at once
struct ReferenceScene {
  std::string name, xml;
  int replications;  // of 64 samples that the reference integrator needs
};
void PrintTo(const ReferenceScene& scene, std::ostream* out);

const std::vector<ReferenceScene>& reference_scenes();

/// Writes the files that these scenes refer to.
void write_reference_files(const TemporaryFolder& folder);

}  // namespace brume::test
