// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace brume {

/// Does one thing after the other, whatever becomes of those before.
class Attempts {
 public:
  /// Whether it succeeded.
  template <class Action>
  bool attempt(const Action& action) {
    try {
      action();
      return true;
    } catch (const Error& error) {
      failures_.emplace_back(error.what());
      return false;
    }
  }

  /// Throws an Error that tells all that failed.
  void check() const {
    if (failures_.empty()) return;
    std::string message = failures_.front();
    for (std::size_t i = 1; i < failures_.size(); ++i) message += "\nbrume: " + failures_[i];
    throw Error(message, ErrorKind::kEnvironment);
  }

 private:
  std::vector<std::string> failures_;
};

}  // namespace brume
