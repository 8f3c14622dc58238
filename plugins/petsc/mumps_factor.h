// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <dmumps_c.h>
#include <mpi.h>

#include "pages_on_disk.h"

namespace buckens_petsc {

/// Entries of a triangle of a symmetric matrix on one process: those of some of its columns.
struct TrianglePart {
  int size = 0;                 ///< of the whole matrix
  int first = 0;                ///< column
  int count = 0;                ///< of the columns here
  const int* starts = nullptr;  ///< from starts[0], not always 0
  const int* rows = nullptr;
  const double* values = nullptr;
};

/// Factor of a symmetric positive definite matrix by MUMPS, distributed over processes that call
/// all its functions together.
///
/// Called directly and not by PETSc, since PETSc cannot pass on an order of elimination for a
/// matrix on several processes, and Debian's MUMPS has neither METIS nor Scotch.
class MumpsFactor {
 public:
  explicit MumpsFactor(MPI_Comm comm);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Alone; copies the entries. @param order of the first process, others null: the variable at
  /// each place
  /// @return whether there was enough memory
  bool prepare(const TrianglePart& part, const int* order);
  /// @return whether it was possible; otherwise take_reason() tells why not, on all processes
  bool make();
  /// @param b,x of variables(). @return as make()
  bool solve(const double* b, double* x);

  /// Those whose right-hand sides and answers are here.
  const std::vector<int>& variables() const { return variables_; }
  /// Whether make() has found that the matrix is not positive definite, the same on all.
  bool is_indefinite() const { return is_indefinite_; }
  /// Of all processes, the same on all.
  double entries() const;

 private:
  int number_of_processes() const;
  void begin(MPI_Comm comm);
  bool run(int job);
  bool analyse();
  bool analyse_entries();
  int place_of_first() const;
  bool exchange_places(int place);
  bool factorise();
  bool set_aside(double numbers);
  double numbers_at_first() const;
  bool is_positive_definite();
  bool find_variables();

  DMUMPS_STRUC_C mumps_{};
  MPI_Comm comm_;
  MPI_Comm reordered_ = MPI_COMM_NULL;  // the processes in the order in which MUMPS has them
  // Room for the factor and for fronts that wait; when it is made, memory of the factor.
  PagesOnDisk room_;
  // Until the factor is made: values, rows and columns, and places of the variables, from 1.
  PagesOnDisk pages_;
  bool is_indefinite_ = false;
  int size_ = 0;
  long entries_ = 0;
  std::vector<int> places_;
  std::vector<int> variables_;
  std::vector<int> right_, answer_;  // the same from 1, as MUMPS takes and gives them
};

}  // namespace buckens_petsc
