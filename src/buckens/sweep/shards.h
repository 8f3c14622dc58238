// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "buckens/sweep/table.h"

namespace buckens::sweep {

/// One of the parts into which a sweep is divided among processes that know nothing of each other.
struct Shard {
  int index = 1;  ///< 1 … count
  int count = 1;

  /// "2-of-8", for names of files.
  std::string name() const;
};

/// @param text "I/N" with 1 ≤ I ≤ N
/// @throws InputError
Shard parse_shard(const std::string& text);

/// Groups of variants whose flexible bodies have the same step matrices, so that they can share
/// factors: a number per variant, counted from 0 in the order of the table.
///
/// Not every variant is built for this. The columns of the table that change a matrix are found by
/// comparing the contents of all matrices between the first variant and one with another value in
/// that column; variants with equal texts in all such columns form a group. A division that is too
/// fine or too coarse costs time, never correctness.
/// @throws what reading the model throws
std::vector<int> matrix_groups(const std::filesystem::path& model,
                               const std::vector<std::string>& overrides, const SweepTable& table);

/// Indices of the variants of each shard, group by group: shards are equally large, and a group is
/// divided only if it is larger than a shard.
std::vector<std::vector<std::size_t>> divide_into_shards(const std::vector<int>& groups, int count);

/// The table with only these variants, in this order.
SweepTable selected(const SweepTable& table, const std::vector<std::size_t>& variants);

}  // namespace buckens::sweep
