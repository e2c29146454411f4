// SPDX-License-Identifier: Apache-2.0
#pragma once

// Private to the volume readers of this folder: OpenVDB is named here and in grid_builder.h, and
// in no other header.

#include <openvdb/Grid.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/volume_file.h"

namespace brume {

/// A file of named sparse grids, open for reading.
class GridFile {
 public:
  virtual ~GridFile() = default;

  /// In the order of the file; selectors are not set.
  virtual std::vector<GridSummary> summaries() = 0;

  /// Reads one grid whole. Precondition: its summary has channels.
  virtual openvdb::GridBase::Ptr read(std::size_t index) = 0;
};

std::unique_ptr<GridFile> open_vdb_file(const std::string& path);
std::unique_ptr<GridFile> open_nvdb_file(const std::string& path);

/// Runs `work`, which calls into OpenVDB or reads a stream that throws, and turns whatever it
/// throws into an Error that begins with `label`.
void with_clear_errors(const std::string& label, const std::function<void()>& work);

}  // namespace brume
