// SPDX-License-Identifier: Apache-2.0
#include "app/render_checkpoint.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/input.h"
#include "app/render_fingerprint.h"
#include "core/error.h"

namespace brume {

RenderCheckpoint::RenderCheckpoint(const RenderOptions& options, const LoadedScene& loaded,
                                   std::string path, Film& film)
    : path_(std::move(path)), film_(film) {
  if (!options.keeps_checkpoint()) return;
  fingerprint_ = render_fingerprint(options, loaded, film.layers());
  if (!options.resume) return;
  if (std::filesystem::exists(path_)) {
    state_ = read_checkpoint(path_, *fingerprint_, film);
    return;
  }
  Notices notices;
  notices.note(fmt::format("there is no {} to resume: rendering from the start", path_));
  print_notices(notices, options.quiet);
}

void RenderCheckpoint::save(const RenderState& state) const {
  if (fingerprint_) write_checkpoint(path_, *fingerprint_, state, film_);
}

void RenderCheckpoint::save_or_warn(const RenderState& state) const {
  try {
    save(state);
  } catch (const Error& error) {
    fmt::print(stderr, "warning: {}; an older checkpoint is kept, and rendering goes on\n",
               error.what());
  }
}

}  // namespace brume
