// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/options.h"
#include "io/scene_file.h"
#include "render/checkpoint.h"

namespace brume {

/// The file that a render is saved to and continued from, if the options ask for one.
class RenderCheckpoint {
 public:
  /// Fills `film` from the file at `path` where the options say so and it is there. Throws an Error
  /// when it is not of this render.
  RenderCheckpoint(const RenderOptions& options, const LoadedScene& loaded, std::string path,
                   Film& film);

  /// How far an earlier run came.
  const RenderState& state() const { return state_; }

  void save(const RenderState& state) const;
  /// The same in the middle of a render, which what is wrong with a disk does not end.
  void save_or_warn(const RenderState& state) const;

 private:
  std::string path_;
  Film& film_;
  std::optional<Fingerprint> fingerprint_{};  // none: the options ask for no file
  RenderState state_{};
};

}  // namespace brume
