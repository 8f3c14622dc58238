// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace buckens::linalg {

/// Rows of one front that are rows of another, by runs that follow one another in both: what makes
/// adding columns fast.
class RowRuns {
 public:
  /// @param places rows of the other front, ascending @param first row of this one for the first
  explicit RowRuns(std::span<const int> places, int first = 0) {
    for (int i = 0; i < static_cast<int>(places.size()); ++i) {
      const int place = places[static_cast<std::size_t>(i)];
      if (runs_.empty() || runs_.back().place + runs_.back().count != place) {
        runs_.push_back({first + i, place, 0});
      }
      ++runs_.back().count;
    }
  }

  /// Row of the other front for a row of this one.
  int place(int row) const {
    const Run& run = *run_of(row);
    return run.place + (row - run.begin);
  }
  /// Whether the rows begin … end follow one another in the other front.
  bool is_one_run(int begin, int end) const {
    const Run& run = *run_of(begin);
    return end <= run.begin + run.count;
  }
  /// Adds values[i − begin] to `column`, which is of the other front, for the rows begin … end.
  void add(const double* values, int begin, int end, double* column) const {
    for (auto run = run_of(begin); begin < end; ++run) {
      const int stop = std::min(end, run->begin + run->count);
      double* to = column + run->place + (begin - run->begin);
      const int length = stop - begin;
      for (int i = 0; i < length; ++i) to[i] += values[i];
      values += length;
      begin = stop;
    }
  }

 private:
  struct Run {
    int begin, place, count;
  };

  std::vector<Run>::const_iterator run_of(int row) const {
    return std::ranges::upper_bound(runs_, row, {}, &Run::begin) - 1;
  }

  std::vector<Run> runs_;
};

}  // namespace buckens::linalg
