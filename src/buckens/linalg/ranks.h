// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/linalg/factor.h"

namespace buckens::linalg {

/// Which of how many processes this one is, as mpirun says in its environment (Open MPI, MPICH).
struct StartedProcesses {
  int rank = 0, count = 1;
  int rank_on_machine = 0;  ///< among those on the same machine
};
StartedProcesses started_processes();

/// Processes that mpirun started, among which large factors and iterative solvers are distributed.
///
/// The first one does everything else; the others hold rows of matrices and of factors, and serve
/// its solves. At most one object, which outlives all solvers.
class Ranks {
 public:
  /// @throws IoError if there is no plug-in (grid_library.h)
  Ranks();
  /// Of the first: ends the others.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  bool is_first() const { return rank_ == 0; }
  /// Of the others: returns when the first has ended.
  void serve();
  /// Processes that share the work now; 1 without an object.
  static int count();

 private:
  int rank_ = 0;
};

/// Factor of a matrix by MUMPS, distributed over all processes.
/// @throws NumericalError if A is not finite or not positive definite, or memory is too small
std::shared_ptr<const Factor> make_shared_factor(const SparseMatrix& A);

/// What makes the factors of bodies unless they iterate: SparseCholesky in this process, or, where
/// several share the work and A is large, make_shared_factor().
std::shared_ptr<const Factor> make_large_factor(const SparseMatrix& A);

}  // namespace buckens::linalg
