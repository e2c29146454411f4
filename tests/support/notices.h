// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/notices.h"

namespace brume::test {

/// Each notice as the program prints it.
inline std::vector<std::string> in_words(const Notices& notices) {
  std::vector<std::string> words;
  for (const Notice& notice : notices.all())
    words.push_back((notice.is_warning ? "warning: " : "note: ") + notice.text);
  return words;
}

}  // namespace brume::test
