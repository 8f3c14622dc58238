// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/shared_matrix.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>

#include "buckens/linalg/column_content.h"
#include "buckens/linalg/same_bits.h"

namespace buckens::linalg {

struct SharedMatrix::Held {
  SparseMatrix A;
  Make again;
  Eigen::Index rows = 0, entries = 0;
  std::array<std::uint64_t, 2> content{};  // once it was let go of
  std::atomic<bool> is_here = true;
  std::mutex making;
};

SharedMatrix::SharedMatrix(SparseMatrix&& A, Make again) : held_(std::make_shared<Held>()) {
  held_->A.swap(A);
  held_->again = std::move(again);
  held_->rows = held_->A.rows();
  held_->entries = held_->A.nonZeros();
}

Eigen::Index SharedMatrix::rows() const { return held_->rows; }

Eigen::Index SharedMatrix::nonZeros() const { return held_->entries; }

const SparseMatrix& SharedMatrix::operator*() const {
  if (!held_->is_here) {
    const std::scoped_lock lock(held_->making);
    if (!held_->is_here) {
      SparseMatrix A = held_->again();
      held_->A.swap(A);
      held_->is_here = true;
    }
  }
  return held_->A;
}

bool SharedMatrix::is_here() const { return held_->is_here; }

void SharedMatrix::let_go() const {
  if (!held_ || !held_->again || !held_->is_here) return;
  held_->content = symmetric_content(held_->A);
  SparseMatrix nothing;
  held_->A.swap(nothing);
  held_->is_here = false;
}

bool SharedMatrix::has_same_bits(const SharedMatrix& other) const {
  if (held_ == other.held_) return true;
  if (!held_ || !other.held_) return false;
  if (is_here() && other.is_here()) return have_same_bits(held_->A, other.held_->A);
  const auto content = [](const SharedMatrix& of) {
    return of.is_here() ? symmetric_content(of.held_->A) : of.held_->content;
  };
  return rows() == other.rows() && nonZeros() == other.nonZeros() &&
         content(*this) == content(other);
}

}  // namespace buckens::linalg
