// SPDX-License-Identifier: Apache-2.0
#include "kept_columns.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "arrays_aside.h"

namespace buckens_petsc {

/// What is kept moves to the front of the lists, over what has been read.
KeptColumns::KeptColumns(const std::vector<int>& starts, std::vector<int>&& rows,
                         std::vector<double>&& values)
    : rows_(std::move(rows)), values_(std::move(values)) {
  const auto move_down = [](auto& list, int from, int to, int count) {
    if (to < from) std::copy_n(list.begin() + from, count, list.begin() + to);
  };
  places_.reserve(starts.size() - 1);
  int end_of_rows = 0, end_of_values = 0;
  int last_list = 0;  // from where on
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    const int size = starts[k + 1] - starts[k];
    const int* own_rows = rows_.data() + starts[k];
    const double* own_values = values_.data() + starts[k];
    Place at{end_of_rows, end_of_values, size, 0};
    const int from = end_of_rows - size;
    const int moved = size > 0 && from >= last_list ? own_rows[0] - rows_[from] : 0;
    if (size > 0 && from >= last_list && ends_with(from, moved, own_rows, size)) {
      at.row = from;
      at.moved = moved;
    } else {
      move_down(rows_, starts[k], end_of_rows, size);
      last_list = end_of_rows;
      end_of_rows += size;
    }
    const bool is_as_before =
        k > 0 && places_.back().size == size &&
        std::memcmp(values_.data() + places_.back().value, own_values, sizeof(double) * size) == 0;
    if (is_as_before) {
      at.value = places_.back().value;
    } else {
      move_down(values_, starts[k], end_of_values, size);
      end_of_values += size;
    }
    places_.push_back(at);
  }
  rows_.resize(static_cast<std::size_t>(end_of_rows));
  rows_.shrink_to_fit();
  values_.resize(static_cast<std::size_t>(end_of_values));
  values_.shrink_to_fit();
}

bool KeptColumns::ends_with(int from, int moved, const int* rows, int size) const {
  return std::equal(rows, rows + size, rows_.data() + from,
                    [moved](int row, int before) { return row == before + moved; });
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
