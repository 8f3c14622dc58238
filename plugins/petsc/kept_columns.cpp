// SPDX-License-Identifier: Apache-2.0
#include "kept_columns.h"

#include <algorithm>
#include <cstring>

#include "arrays_aside.h"

namespace buckens_petsc {

void KeptColumns::reserve(std::size_t columns, std::size_t entries) {
  places_.reserve(columns);
  rows_.reserve(entries);
  values_.reserve(entries);
}

void KeptColumns::add(const int* rows, const double* values, int size) {
  const auto count = static_cast<std::size_t>(size);
  const auto row_end = static_cast<int>(rows_.size());
  const auto value_end = static_cast<int>(values_.size());
  Place at{row_end - size, value_end - size, size, 0};
  if (size > 0 && at.row >= last_list_) {
    at.moved = rows[0] - rows_[static_cast<std::size_t>(at.row)];
  }
  const bool has_rows = at.row >= last_list_ &&
                        std::equal(rows, rows + size, rows_.begin() + at.row,
                                   [&at](int row, int before) { return row == before + at.moved; });
  if (!has_rows) {
    rows_.insert(rows_.end(), rows, rows + size);
    at.row = last_list_ = row_end;
    at.moved = 0;
  }
  const bool has_values =
      at.value >= 0 && !places_.empty() && places_.back().size == size &&
      places_.back().value == at.value &&
      std::memcmp(values_.data() + at.value, values, sizeof(double) * count) == 0;
  if (!has_values) {
    values_.insert(values_.end(), values, values + size);
    at.value = value_end;
  }
  places_.push_back(at);
}

void KeptColumns::add(const std::vector<int>& starts, const std::vector<int>& rows,
                      const std::vector<double>& values) {
  reserve(places_.size() + starts.size() - 1, values_.size() + values.size());
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    add(rows.data() + starts[k], values.data() + starts[k], starts[k + 1] - starts[k]);
  }
}

void KeptColumns::list(std::vector<int>& starts, std::vector<int>& rows,
                       std::vector<double>& values) const {
  starts.assign(1, 0);
  for (const Place& at : places_) starts.push_back(starts.back() + at.size);
  rows.clear();
  values.clear();
  rows.reserve(static_cast<std::size_t>(starts.back()));
  values.reserve(rows.capacity());
  for (int k = 0; k < count(); ++k) {
    const Column of = column(k);
    for (int e = 0; e < of.size; ++e) rows.push_back(of.row(e));
    values.insert(values.end(), of.values, of.values + of.size);
  }
}

std::size_t KeptColumns::bytes() const {
  return sizeof(Place) * places_.size() + sizeof(int) * rows_.size() +
         sizeof(double) * values_.size();
}

void KeptColumns::put(ArraysAside& aside) {
  aside.put(rows_);
  aside.put(values_);
}

void KeptColumns::lose() {
  for (Place& at : places_) at.size = 0;
}

}  // namespace buckens_petsc
