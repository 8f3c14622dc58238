// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "buckens/linalg/factor.h"
#include "buckens/linalg/grid_plugin.h"
#include "buckens/linalg/matrix_sum.h"

namespace buckens::linalg {

/// Which of how many processes this one is, as mpirun says in its environment (Open MPI, MPICH).
struct StartedProcesses {
  int rank = 0, count = 1;
  int rank_on_machine = 0;  ///< among those on the same machine
};
StartedProcesses started_processes();

/// What the first process has sent to the others and received from them: rows of matrices, orders,
/// right-hand sides and answers. What MUMPS and PETSc exchange among all is not counted.
struct Traffic {
  long messages = 0;
  double bytes = 0;
  /// Memory that divided matrices took here when they came back (SymmetricMatrix::whole()).
  double bytes_of_whole_matrices = 0;

  Traffic since(const Traffic& before) const {
    return {messages - before.messages, bytes - before.bytes,
            bytes_of_whole_matrices - before.bytes_of_whole_matrices};
  }
};

/// Columns `first` to `end` − 1, of a symmetric matrix from the diagonal on, n×(end − first), made
/// of a description that the first process has sent (DescribeColumns).
using MakeColumns = SparseMatrix (*)(std::span<const std::byte> description, int first, int end);

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
  /// @param make what they make columns by (DividedMatrix)
  void serve(MakeColumns make);
  /// Processes that share the work now; 1 without an object.
  static int count();
  /// Zeros without an object.
  static Traffic traffic();

 private:
  int rank_ = 0;
};

/// Smaller factors are solved faster than vectors are sent.
constexpr Eigen::Index kWorthSharing = 20000;

/// Whether several processes share the work with so many variables.
bool is_shared_work(Eigen::Index variables);

/// From how many variables on they do, instead of kWorthSharing. @pre there is no body yet, and
/// these are at least kFewestShared
void share_from(Eigen::Index variables);
/// Shorter vectors are copied instead of shared (NodalVector), so other processes cannot have them.
constexpr Eigen::Index kFewestShared = 64;

/// What makes the factors of bodies unless they iterate: SparseCholesky in this process, or, where
/// several share the work and A is large, MUMPS, with the factor distributed over all. No process
/// then holds more of A than the rows of one of them.
/// Where they share it, all terms that can be divided are divided among the others from then on,
/// which form the sum (SymmetricMatrix).
/// @throws IndefiniteMatrix if A is not positive definite
/// @throws NumericalError if A is not finite or memory is too small
std::shared_ptr<const Factor> make_large_factor(const MatrixSum& A);

/// Gives columns of a sum to the plug-in (BuckensGridMatrix::give), one run of them at a time.
class ColumnSource {
 public:
  explicit ColumnSource(const MatrixSum& A, Triangles which = Triangles::both)
      : A_(&A), which_(which) {}
  /// With this object as `source`.
  static void give(void* source, int first, int end, BuckensGridColumns* columns);
  /// Of all columns that were given.
  double entries() const { return entries_; }

 private:
  const MatrixSum* A_;
  Triangles which_;
  SparseMatrix piece_;
  double entries_ = 0;
};

}  // namespace buckens::linalg
