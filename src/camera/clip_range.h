// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// What a camera sees lies between two planes across its optical axis.
struct ClipRange {
  double near = 1e-2;  // along the axis [unit], >= 0
  double far = 1e4;    // along the axis [unit], > near; may be infinite
};

}  // namespace brume
