// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

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

/// Long lists of numbers stay in the file, which is open until the last copy of what this returns
/// is gone. They are read when a visit asks for them; if the file has changed by then, this is an
/// IoError. Another file may take its place.
/// @throws IoError if the file cannot be read, is not a saved state, has another format, is
/// truncated or damaged
base::SavedValues read_state(const std::filesystem::path& path);

}  // namespace buckens::run_store
