// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/results/channel.h"
#include "buckens/results/geometry.h"

namespace buckens::results {

/// Rows of a channel per chunk of results.h5: about 64 KiB of double precision, so that large
/// channels do not need much memory nor small ones many chunks; at most 256 rows, because even a
/// partly filled chunk takes its full size.
std::size_t chunk_rows(std::size_t values_per_row);

/// Size of a table of records in results.h5 [bytes]: whole chunks, plus the overhead of each data
/// set, which is known to about 10 %.
/// @param rows records, @param value_size of one value in the file [bytes]
double stored_bytes(const RecordLayout& layout, double rows, std::size_t value_size);

/// The same for data sets without rows.
double stored_bytes(const RecordLayout& layout);

/// Size of the undeformed shape there [bytes].
double stored_bytes(const Geometry& geometry);

}  // namespace buckens::results
