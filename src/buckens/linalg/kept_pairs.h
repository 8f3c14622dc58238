// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_parts.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

/// Pairs of loads cᵢ and answers in single precision, and the arithmetic that reads all of them, in
/// double precision (RecycledSolves). Results are bitwise the same with any number of threads, and
/// from run to run.
class KeptPairs {
 public:
  virtual ~KeptPairs() = default;

  /// r ← r − Σ αᵢ cᵢ with αᵢ = cᵢᵀ r over the first pairs, rounded to single precision, as a load
  /// that is kept is. @param along gets the αᵢ. @return ‖r‖
  virtual double project(int pairs, Vector& r, Vector& along, TaskPool* pool) = 0;
  /// x ← Σ wᵢ xᵢ, scaled, or added to x. @param scale by which each row is multiplied
  virtual void combine(int pairs, const Vector& weights, const Eigen::VectorXf& scale, bool adds,
                       Vector& x, TaskPool* pool) const = 0;
  /// Takes from a load what lies along a pair's, and as much of the pair's answer from its answer.
  virtual void separate(int pair, Vector& load, Vector& answer, TaskPool* pool) = 0;
  /// Keeps both, scaled.
  virtual void put(int pair, double scale, const Vector& load, const Vector& answer,
                   TaskPool* pool) = 0;
  virtual void take(int pair, Eigen::VectorXf& load, Eigen::VectorXf& answer) const = 0;
  /// Keeps what take() gave.
  virtual void restore(int pair, const Eigen::VectorXf& load, const Eigen::VectorXf& answer) = 0;
  /// By which other processes know them; −1: they are in this one.
  virtual int number() const { return -1; }

 protected:
  KeptPairs() = default;
  KeptPairs(const KeptPairs&) = default;
  KeptPairs& operator=(const KeptPairs&) = default;
};

/// Room for `most` pairs of vectors with so many rows: in this process, or, where several share the
/// work and there are many rows, divided among the others (ranks.h).
/// @param order of the rows of the others
std::unique_ptr<KeptPairs> make_kept_pairs(Eigen::Index rows, int most, SharedRowOrder order);

}  // namespace buckens::linalg
