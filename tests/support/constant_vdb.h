// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace brume::test {

/// Writes an OpenVDB file with one grid, "density": n^3 active voxels of `value` that fill the unit
/// cube, and 0 around it.
void write_constant_vdb(const std::filesystem::path& path, int n, double value);

}  // namespace brume::test
