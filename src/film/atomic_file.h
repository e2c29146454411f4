// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace brume {

/// Puts a file at `path` that holds `bytes`, whole or not at all: an older file stays as it was
/// until the new one is safely on the disk. Throws Error naming the path and the reason.
void write_file_atomically(const std::string& path, std::span<const unsigned char> bytes);
/// The same for bytes in several pieces.
void write_file_atomically(const std::string& path,
                           std::span<const std::span<const unsigned char>> pieces);

/// Throws Error when a file could not be put at `path`: the folder is missing or not writable, or
/// `path` is a folder itself.
void check_writable(const std::string& path);

}  // namespace brume
