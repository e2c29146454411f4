// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/image.h"

namespace brume {

class Film;

/// The film as a picture: R, G, B and A (opacity seen along the camera ray; the colours are not
/// divided by it), `stderr.R`, `.G`, `.B` (standard error of the mean), `samples`, and where the
/// film has them `albedo.R`, `.G`, `.B` and `depth.Z` (infinite where nothing was met).
Image develop(const Film& film);

}  // namespace brume
