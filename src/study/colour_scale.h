// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/rgb.h"

namespace brume {

/// Colour of `u` in [0, 1], clamped, on a scale from dark blue over grey to light yellow, linear
/// Rec. 709. Perceived lightness grows in proportion to u, so that the order can be seen without
/// colour vision, and blue against yellow can be told apart with all common kinds of it.
Rgb scale_colour(double u);

}  // namespace brume
