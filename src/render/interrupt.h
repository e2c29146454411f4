// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// While it lives, the first SIGINT (Ctrl-C) or SIGTERM only asks the render to stop, so that what
/// was rendered can be saved; the next one ends the program. At most one lives at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Whether a signal has come since the last guard was made.
bool interrupt_requested();

}  // namespace brume
