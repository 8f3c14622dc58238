// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/table_rows.h"

#include <algorithm>
#include <utility>

namespace buckens::run_store {

namespace {

// Two tables, each in the records of an animation and in one that is shown by itself.
constexpr std::size_t kMostBlocks = 4;

}  // namespace

std::vector<double> TableRows::get(const RowWish& wish, std::span<const std::size_t> records,
                                   const Read& read) {
  const Block* known = find(wish, records);
  const Block& block = known != nullptr ? *known : add(wish, records, read);
  std::vector<double> out;
  out.reserve(records.size() * wish.count);
  for (std::size_t k = 0; k < records.size(); ++k) {
    const std::size_t row = k * block.count + wish.row - block.first;
    const auto at =
        block.values.begin() + static_cast<std::ptrdiff_t>(row * wish.width + wish.first);
    out.insert(out.end(), at, at + static_cast<std::ptrdiff_t>(wish.count));
  }
  return out;
}

const TableRows::Block* TableRows::find(const RowWish& wish,
                                        std::span<const std::size_t> records) const {
  for (const Block& block : blocks_) {
    const bool has_row = wish.row >= block.first && wish.row < block.first + block.count;
    if (has_row && block.table == wish.table &&
        std::equal(records.begin(), records.end(), block.records.begin(), block.records.end())) {
      return &block;
    }
  }
  return nullptr;
}

const TableRows::Block& TableRows::add(const RowWish& wish, std::span<const std::size_t> records,
                                       const Read& read) {
  const std::size_t of_one = std::max<std::size_t>(records.size() * wish.width, 1);
  const std::size_t count = std::clamp<std::size_t>(most_values_ / of_one, 1, wish.rows - wish.row);
  Block block{wish.table, {records.begin(), records.end()}, wish.row, count, {}};
  block.values = read(wish.table, records, wish.row, count);
  if (blocks_.size() < kMostBlocks) return blocks_.emplace_back(std::move(block));
  Block& place = blocks_[std::exchange(oldest_, (oldest_ + 1) % kMostBlocks)];
  place = std::move(block);
  return place;
}

}  // namespace buckens::run_store
