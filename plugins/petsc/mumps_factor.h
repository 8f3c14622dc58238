// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <dmumps_c.h>
#include <mpi.h>

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

/// Address space whose memory is there when it is used, and can be given back.
class Workspace {
 public:
  Workspace() = default;
  ~Workspace() { set_aside(0); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// @return whether it was possible; what was there before goes
  bool set_aside(std::size_t numbers);
  /// Gives back what is behind the first numbers.
  void keep(std::size_t numbers);
  double* data() const { return data_; }

 private:
  double* data_ = nullptr;
  std::size_t bytes_ = 0;
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

  /// Alone. @param part its values must live until make() has ended
  /// @param order of the first process, others null: the variable at each place
  /// @return whether there was enough memory
  bool prepare(const TrianglePart& part, const int* order);
  /// @return whether it was possible; otherwise take_reason() tells why not, on all processes
  bool make();
  /// @param b,x of variables(). @return as make()
  bool solve(const double* b, double* x);

  /// Those whose right-hand sides and answers are here.
  const std::vector<int>& variables() const { return variables_; }
  /// Of all processes, the same on all.
  double entries() const;

 private:
  int number_of_processes() const;
  bool run(int job);
  bool factorise();
  bool set_aside(double numbers);
  double numbers_at_first() const;
  bool is_positive_definite();
  bool find_variables();

  DMUMPS_STRUC_C mumps_{};
  MPI_Comm comm_;
  Workspace workspace_;
  std::vector<int> rows_, columns_, places_;  // from 1, until the factor is made
  std::vector<int> variables_;
  std::vector<int> right_, answer_;  // the same from 1, as MUMPS takes and gives them
};

}  // namespace buckens_petsc
