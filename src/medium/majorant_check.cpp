// SPDX-License-Identifier: Apache-2.0
#include "medium/majorant_check.h"

#include <atomic>

namespace brume {
namespace {
std::atomic<std::uint64_t> violations{0};
}

std::uint64_t majorant_violations() {
  return violations.load();
}

void detail::count_majorant_violation() {
  ++violations;
}

}  // namespace brume
