// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_neighbours.h"

#include <algorithm>
#include <utility>

#include "buckens/linalg/counted_entries.h"

namespace buckens::linalg {

namespace {

void sort_once(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

RowNeighbours::RowNeighbours(std::span<const int> first_units, std::size_t place, RowTables& own)
    : first_units_(first_units), place_(place), own_(&own), sent_(first_units.size() - 1) {
  own.first = first_units[place];
  own.count = first_units[place + 1] - own.first;
}

void RowNeighbours::add(int unit, int other) {
  if (is_here(other)) return;
  own_->beside.push_back(other);
  const auto who = std::upper_bound(first_units_.begin(), first_units_.end(), other) - 1;
  std::vector<int>& list = sent_[static_cast<std::size_t>(who - first_units_.begin())];
  if (list.empty() || list.back() != unit) list.push_back(unit);
}

void RowNeighbours::finish() {
  sort_once(own_->beside);
  for (std::size_t k = 0; k < sent_.size(); ++k) {
    const auto begin = std::lower_bound(own_->beside.begin(), own_->beside.end(), first_units_[k]);
    const auto end = std::lower_bound(begin, own_->beside.end(), first_units_[k + 1]);
    own_->in_counts.push_back(k == place_ ? 0 : static_cast<int>(end - begin));
    sort_once(sent_[k]);
    own_->out_counts.push_back(static_cast<int>(sent_[k].size()));
    for (const int unit : sent_[k]) own_->sent.push_back(unit - own_->first);
  }
}

int RowNeighbours::place_of(int unit) const {
  if (is_here(unit)) return unit - own_->first;
  const auto found = std::lower_bound(own_->beside.begin(), own_->beside.end(), unit);
  return own_->count + static_cast<int>(found - own_->beside.begin());
}

SparseMatrix columns_at_places(const SparseMatrix& A, const RowTables& own, const UnitOrder& order,
                               const RowNeighbours& beside) {
  std::vector<std::pair<int, double>> of_column;
  const auto visit = [&](auto&& entry) {
    for (int k = 0; k < own.count; ++k) {
      of_column.clear();
      for (SparseMatrix::InnerIterator it(A, order.number(own.first + k)); it; ++it) {
        const int unit = order.unit(static_cast<int>(it.row()));
        of_column.emplace_back(beside.place_of(unit), it.value());
      }
      std::ranges::sort(of_column, {}, &std::pair<int, double>::first);
      for (const auto& [place, value] : of_column) entry(place, k, value);
    }
  };
  return from_counted_entries(static_cast<int>(A.rows()), own.count, visit);
}

}  // namespace buckens::linalg
