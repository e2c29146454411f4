// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "scene/scene.h"

namespace brume {

/// Two boundaries that declare different media for the space between them: bodies overlap, or one
/// stands in the other and does not declare it as its exterior. What a place is filled with then
/// depends on the way that light took to it, and light that comes from the lamps meets other media
/// than paths that come from the camera.
struct Contradiction {
  std::uint32_t from, to;  // surfaces, in Scene::surfaces
  const Medium* left;      // medium of `from` on the side of `to`; null is vacuum
  const Medium* met;       // of `to` on the side of `from`
};

/// Looks for one by following light from all boundaries, of which it may miss small ones; nothing
/// where they agree but for rare rays that rounding leads astray.
std::optional<Contradiction> find_contradiction(const Scene& scene);

}  // namespace brume
