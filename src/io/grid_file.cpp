// SPDX-License-Identifier: Apache-2.0
#include "io/grid_file.h"

#include <fmt/format.h>

#include <ios>
#include <new>
#include <string_view>

#include "core/error.h"

namespace brume {

void with_clear_errors(const std::string& label, const std::function<void()>& work) {
  try {
    work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(fmt::format("{}: not enough memory, unless the file is damaged", label),
                ErrorKind::kEnvironment);
  } catch (const std::ios_base::failure&) {
    throw Error(fmt::format("{}: truncated or damaged: it ends too early", label));
  } catch (const std::exception& e) {
    // OpenVDB puts the name of the class first: "IoError: ...".
    const std::string_view what = e.what();
    const std::size_t colon = what.find("Error: ");
    throw Error(
        fmt::format("{}: damaged: {}", label, colon == what.npos ? what : what.substr(colon + 7)));
  }
}

}  // namespace brume
