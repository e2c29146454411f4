// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace brume {

/// The bytes of a PNG file as the address of an HTML picture (RFC 2397, RFC 4648).
std::string png_data_uri(std::span<const unsigned char> bytes);

}  // namespace brume
