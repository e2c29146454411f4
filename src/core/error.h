// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace brume {

/// Who must act, and so the exit code of the program.
enum class ErrorKind {
  kInput,        // wrong usage or bad input: exit 2
  kEnvironment,  // a file could not be read or written, memory ran out: exit 1
};

/// The one exception of brume. The message is written for the person who reads it: what was found,
/// where (file:line:column where there is one), what was expected, what to do.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, ErrorKind kind = ErrorKind::kInput)
      : std::runtime_error(message), kind_(kind) {}

  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace brume
