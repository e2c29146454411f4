// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace brume {

/// Times that an extinction above its cell's majorant was met since the program began. Counted in
/// builds with BRUME_COUNT_VIOLATIONS, 0 in others; anything but 0 is a bug.
std::uint64_t majorant_violations();

namespace detail {
void count_majorant_violation();
}

/// Records a violation when `sigma_t` > `sigma_maj` [1/unit]; nothing in builds that do not count.
inline void check_majorant([[maybe_unused]] float sigma_t, [[maybe_unused]] float sigma_maj) {
#ifdef BRUME_COUNT_VIOLATIONS
  if (!(sigma_t <= sigma_maj)) detail::count_majorant_violation();
#endif
}

}  // namespace brume
