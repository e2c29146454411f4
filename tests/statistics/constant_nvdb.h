// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace brume::test {

/// Writes a fog volume "density" of n^3 voxels of `value` in the unit cube as .nvdb.
void write_constant_nvdb(const std::filesystem::path& path, int n, double value);

}  // namespace brume::test
