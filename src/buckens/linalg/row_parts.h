// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <type_traits>

#include <Eigen/Core>

#include "buckens/base/task_pool.h"

namespace buckens::linalg {

/// f(part, first row, number of rows) of RowParts::for_pieces(); must outlive this object.
class PieceFunction {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_const_t<F>, PieceFunction>)
      PieceFunction(F& f)  // NOLINT: any such function is one
      : context_(const_cast<void*>(static_cast<const void*>(&f))),
        call_([](void* context, int part, Eigen::Index first, Eigen::Index size) {
          (*static_cast<F*>(context))(part, first, size);
        }) {}
  void operator()(int part, Eigen::Index first, Eigen::Index size) const {
    call_(context_, part, first, size);
  }

 private:
  void* context_;
  void (*call_)(void*, int, Eigen::Index, Eigen::Index);
};

/// Rows of large vectors in parts that may be processed concurrently, and in pieces that stay in
/// the L1 and L2 caches while several operations are done on them.
///
/// Both depend on the number of rows only. Sums over rows must be kept per part and added in the
/// order of the parts: then they are bitwise the same with any number of threads.
class RowParts {
 public:
  static constexpr int kMostParts = 16;
  static constexpr Eigen::Index kPiece = 1024;  ///< most rows of a piece

  /// @param unit rows that stay in one piece, a divisor of `rows`
  explicit RowParts(Eigen::Index rows, Eigen::Index unit = 1)
      : rows_(rows),
        unit_(unit),
        count_(static_cast<int>(std::clamp<Eigen::Index>(rows / kPart, 1, kMostParts))) {}

  Eigen::Index rows() const { return rows_; }
  int count() const { return count_; }
  Eigen::Index begin(int part) const { return rows_ / unit_ * part / count_ * unit_; }
  Eigen::Index end(int part) const { return begin(part + 1); }

  /// Calls f(part, first row, number of rows) for every piece, those of a part in ascending order.
  template <class F>
  void for_pieces(TaskPool* pool, F&& f) const {
    const Eigen::Index piece = kPiece / unit_ * unit_;
    run_tasks(pool, count_, [&](int part) {
      const Eigen::Index last = end(part);
      for (Eigen::Index at = begin(part); at < last; at += piece) {
        f(part, at, std::min(piece, last - at));
      }
    });
  }

 private:
  // Waking a thread costs as much as processing so many rows of several vectors.
  static constexpr Eigen::Index kPart = 2048;

  Eigen::Index rows_, unit_;
  int count_;
};

}  // namespace buckens::linalg
