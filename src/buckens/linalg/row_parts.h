// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "buckens/base/task_pool.h"

namespace buckens::linalg {

/// Rows of large vectors in parts that may be processed concurrently, and in pieces that stay in
/// the L1 and L2 caches while several operations are done on them.
///
/// Both depend on the number of rows only. Sums over rows must be kept per part and added in the
/// order of the parts: then they are bitwise the same with any number of threads.
class RowParts {
 public:
  static constexpr int kMostParts = 16;
  static constexpr Eigen::Index kPiece = 1024;  ///< most rows of a piece

  explicit RowParts(Eigen::Index rows)
      : rows_(rows),
        count_(static_cast<int>(std::clamp<Eigen::Index>(rows / kPart, 1, kMostParts))) {}

  Eigen::Index rows() const { return rows_; }
  int count() const { return count_; }
  Eigen::Index begin(int part) const { return rows_ * part / count_; }
  Eigen::Index end(int part) const { return rows_ * (part + 1) / count_; }

  /// Calls f(part, first row, number of rows) for every piece, those of a part in ascending order.
  template <class F>
  void for_pieces(TaskPool* pool, F&& f) const {
    run_tasks(pool, count_, [&](int part) {
      const Eigen::Index last = end(part);
      for (Eigen::Index at = begin(part); at < last; at += kPiece) {
        f(part, at, std::min(kPiece, last - at));
      }
    });
  }

 private:
  // Waking a thread costs as much as processing so many rows of several vectors.
  static constexpr Eigen::Index kPart = 2048;

  Eigen::Index rows_;
  int count_;
};

}  // namespace buckens::linalg
