// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_parts.h"
#include "buckens/linalg/shared_store.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::linalg {

/// Lets computations that are independent except for common matrices share factors and solve
/// together.
///
/// Each participant runs as if alone until it asks for a solve; then the next one runs.
/// When all wait, those with a common factor solve as the columns of one right-hand side, which
/// reads the factor once for all of them. Passes over common tables go together likewise, piece by
/// piece, and before any solve, so that all participants come to their solves. Only one participant
/// runs at a time, in a fixed order, so results do not depend on timing.
class SolveExchange {
 public:
  /// @param make factorises
  explicit SolveExchange(MakeFactor make = make_cholesky);
  ~SolveExchange();

  /// Factor of a symmetric positive definite matrix. Bitwise equal matrices share one as long as
  /// somebody holds it. Call from participants, or while none runs.
  /// @throws NumericalError as the MakeFactor does
  std::shared_ptr<const Factor> factor(const SparseMatrix& A);

  /// x ← A⁻¹ x for some vectors by a factor from factor(): together with the others if a
  /// participant calls.
  void solve(const Factor& factor, std::span<double* const> vectors, TaskPool* pool = nullptr);

  /// rows.for_pieces(pool, f), together with other participants that ask for the same `table`: each
  /// piece for one after the other, so that what they read of the table is read from memory once.
  /// All that ask for one table have the same rows and pieces, and `f` does not throw.
  void for_pieces(const void* table, const RowParts& rows, TaskPool* pool, PieceFunction f);

  /// What participants have in common besides factors. Call from them, or while none runs.
  SharedStore& common() { return common_; }

  /// Runs all participants to completion, each on its own thread.
  /// @throws the first exception of a participant, after all have finished
  void run(const std::vector<std::function<void()>>& participants);

  long num_factorisations() const { return num_factorisations_; }
  long num_columns() const { return num_columns_; }  ///< solved within run()
  long num_passes() const { return num_passes_; }    ///< times that a factor was read for them

 private:
  struct Known;
  struct Participant;
  struct Turns;

  void serve_waiting();
  void pass_together(const void* table);
  void solve_together(const Factor& factor);
  void solve_group(const std::vector<Participant*>& group);

  MakeFactor make_;
  std::vector<Known> known_;
  SharedStore common_;
  std::vector<std::unique_ptr<Participant>> participants_;  // of the run that goes on
  std::unique_ptr<Turns> turns_;
  std::vector<double*> vectors_;
  std::vector<PieceFunction> together_;
  long num_factorisations_ = 0, num_columns_ = 0, num_passes_ = 0;
};

}  // namespace buckens::linalg
