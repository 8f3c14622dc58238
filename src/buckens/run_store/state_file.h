// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "buckens/base/saved_values.h"

namespace buckens::run_store {

/// Writes a saved state to a file atomically: readers see a whole state or none, also after a loss
/// of power. It is written list after list and takes no memory beside the state.
///
/// An HDF5 file: of numbers, counts and texts a group each with `names` (joined by line ends),
/// `lengths` and `values`. The last kStateTrailer bytes are text that identifies the file and
/// contains its checksum.
/// @throws IoError
void write_state(const base::SavedValues& state, const std::filesystem::path& path);

/// @throws IoError if the file cannot be read, is not a saved state, has another format, is
/// truncated or damaged
base::SavedValues read_state(const std::filesystem::path& path);

/// The bytes of an HDF5 file with their trailer.
std::string sealed(std::string_view content);
/// Of the contents of such a file. @param name of the file in messages
base::SavedValues parse_state(std::string_view bytes, const std::string& name);

inline constexpr int kStateFormat = 1;
inline constexpr std::size_t kStateTrailer = 80;

}  // namespace buckens::run_store
