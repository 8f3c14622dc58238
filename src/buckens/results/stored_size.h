// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/results/channel.h"
#include "buckens/results/geometry.h"

namespace buckens::results {

/// Rows of a channel that results.h5 stores together: about 64 KiB of double precision, so that
/// neither large channels need much memory nor small ones many pieces; at most 256 rows, because
/// a started chunk takes its full size.
std::size_t chunk_rows(std::size_t values_per_row);

/// What a table of records takes in results.h5 [bytes]: whole chunks, and the books of each data
/// set, which are known to about a tenth of themselves.
/// @param rows records, @param value_size of one value in the file [bytes]
double stored_bytes(const RecordLayout& layout, double rows, std::size_t value_size);

/// The same of data sets without rows.
double stored_bytes(const RecordLayout& layout);

/// What the undeformed shape takes there [bytes].
double stored_bytes(const Geometry& geometry);

}  // namespace buckens::results
