// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the volume readers of this folder, see grid_file.h. The trees are OpenVDB trees of
// float, double, Vec3f or Vec3d.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "core/notices.h"

namespace brume {

/// Throws unless every leaf and tile is found again at its own coordinates, and these are small
/// enough for float. Damaged files fail this; searching a tree that does would be undefined.
template <class Tree>
void require_sound_tree(const Tree& tree, const std::string& label);

/// Throws about `count` voxels that are NaN or infinite.
[[noreturn]] void fail_as_non_finite(std::uint64_t count, const glm::ivec3& first,
                                     const glm::dmat4& world_from_index, const std::string& label);

/// Throws when a voxel is NaN or infinite: how many, and where the first one lies (x fastest).
template <class Tree>
void require_finite(const Tree& tree, const glm::dmat4& world_from_index, const std::string& label);

/// Negative values become 0, and every voxel that differs from the background becomes active:
/// interpolation reads inactive voxels too, so activity must not decide what is rendered.
template <class Tree>
void clean(Tree& tree, const std::string& label, Notices& notices);

/// Whether no voxel differs from 0.
template <class Tree>
bool is_zero(const Tree& tree);

}  // namespace brume
