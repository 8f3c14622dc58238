// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <new>
#include <numeric>
#include <vector>

#include "kept_columns.h"
#include "mumps_factor.h"
#include "ranks.h"
#include "reasons.h"
#include "solver_library.h"

namespace buckens_petsc {

enum class Task : int {
  make,
  factorise,
  solve,
  measure,
  release,
  divide,
  divide_rows,
  make_rows,
  make_columns,
  add_up,
  inner_product,
  diagonal,
  near_diagonal,
  marks,
  edges,
  multiply,
  gather,
  forget,
  make_pairs,
  project,
  combine,
  put_pair,
  take_pair,
  begin_rows,
  work_rows,
  put_rows,
  take_rows,
  solve_rows,
  partition,
  find_modes,
  leave
};
constexpr int kMostMotions = 6;

/// What is to be done, the same on all processes.
struct Ranks::Order {
  Task task = Task::leave;
  int number = 0;  // of the solver or matrix
  int size = 0;
  union {
    int block = 1;
    int columns;  // of a matrix that is not symmetric; pairs, or which of them; sums of a program
  };
  int num_motions = 0;
  union {
    int options = 0;
    int gives_rows;  // of what is made: whether the first process says which (BuckensGridRows)
  };
  union {
    BuckensGridLimits limits{};                // of a solve
    std::array<int, kBuckensMostProducts> of;  // matrices of products or of a sum, then −1
    long bytes;                                // of a program
  };

  void set_matrices(const int* numbers, int count) {
    of.fill(-1);
    std::copy_n(numbers, count, of.begin());
  }
  int num_matrices() const {
    return static_cast<int>(std::find(of.begin(), of.end(), -1) - of.begin());
  }
};

/// How numbers come from the processes that have rows of a vector to those that want some of them,
/// such as those that have them in a factor, and back.
struct Ranks::Way {
  /// Each process tells those with rows of the variables that it wants. All of `comm` call it.
  /// @param first rows of its processes, and the end
  Way(const std::vector<int>& variables, const int* first, MPI_Comm comm);
  /// @param rows here @param wanted gets the numbers of the variables
  void bring(const double* rows, double* wanted);
  /// Numbers of the variables come to those with their rows.
  /// @param adds to what is there, process after process, instead of replacing it
  void give_back(const double* wanted, double* rows, bool adds);

  MPI_Comm comm;
  std::vector<int> given;   // rows here, for one process after the other
  std::vector<int> places;  // among the variables, of what one process after the other gives
  std::vector<int> out_counts, out_first, in_counts, in_first;
  std::vector<double> out, in;
};

/// The rows of vectors of a body: those of the processes, and the end.
struct Ranks::Runs {
  std::vector<int> first, counts;
};

/// A solver, and which rows of its matrix are here.
struct Ranks::Part {
  std::unique_ptr<LoadedSolver> solver;
  std::unique_ptr<MumpsFactor> factor;  // in place of a solver of PETSc's
  std::vector<int> first;               // rows of the processes, and the end
  std::vector<int> counts;
  std::vector<int> variables;  // of the factor, process after process; only the first has them
  std::vector<double> b, x, whole;
  std::unique_ptr<Way> way;  // of the rows of others to the factor; null before it is used

  bool is_direct() const { return factor != nullptr || solver->is_direct(); }
  double bytes() const {
    return factor != nullptr ? sizeof(double) * factor->entries() : solver->bytes();
  }
};

/// A matrix of which the first process has nothing: of a symmetric one each other has a run of
/// columns, from the diagonal on, of any other one a run of rows, which are its columns here.
struct Ranks::Divided {
  int size = 0;
  bool is_symmetric = true;
  std::vector<int> first, counts;  // columns of the processes, and the end
  KeptColumns columns;             // those here; rows are places in `variables`
  std::vector<int> variables;      // ascending; of a symmetric one they begin with the columns here
  // Of the first process: `variables` of all, one process after the other.
  std::vector<int> lists, list_first, list_counts;
  // Of the others: of a symmetric matrix to `variables` behind the columns here, of others to all
  // of them, from the rows of vectors; null before it is used.
  std::unique_ptr<Way> way;

  /// Numbers that a process adds to a product, there.
  std::size_t num_results(int rank) const {
    return is_symmetric ? variables.size() : static_cast<std::size_t>(counts[rank]);
  }
  void add_symmetric(int count, const double* x, double* y) const;
  void add_rows(int count, const double* x, double* y) const;
};

/// Pairs of loads and answers, rows of which each process but the first has.
struct Ranks::Pairs {
  std::vector<int> first, counts;           // rows of the processes, and the end
  std::unique_ptr<float[]> loads, answers;  // of those here, pair after pair
  std::vector<double> row;                  // of one vector

  float* of(const std::unique_ptr<float[]>& all, int pair, int rank) const {
    return all.get() + static_cast<std::size_t>(pair) * static_cast<std::size_t>(counts[rank]);
  }
};

struct Ranks::Shared {
  std::map<int, std::unique_ptr<Part>> parts;  // by number
  std::map<int, std::unique_ptr<Divided>> matrices;
  std::map<int, std::unique_ptr<Pairs>> pairs;
  std::map<int, Runs> runs;

  void forget(int number) {
    matrices.erase(number);
    pairs.erase(number);
    runs.erase(number);
  }
  // Of products: what one process gets of all x; what it adds to all y, of the others.
  std::vector<double> share, results;
  std::vector<int> edges;
};

/// Rows of a matrix as they are listed; those of a symmetric one are its columns.
struct Ranks::OwnRows {
  BuckensGridColumns columns{};  // those below, or the first process's
  std::vector<int> starts = {0}, rows;
  std::vector<double> values, motions;
};

/// Runs of equal length for the processes other than the first, which holds everything else of a
/// body: of whole nodes, if there may be three variables for each.
inline std::vector<int> runs_of_others(int size, int count) {
  const int unit = size % 3 == 0 ? 3 : 1;
  std::vector<int> first = {0};
  for (int k = 0; k < count; ++k) {
    first.push_back(static_cast<int>(static_cast<long>(size / unit) * k / (count - 1)) * unit);
  }
  return first;
}

/// Where the shares of processes begin, and the end.
inline std::vector<int> starts_of(const std::vector<int>& counts) {
  std::vector<int> first(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), first.begin() + 1);
  return first;
}

/// Otherwise the reason is set.
template <class Action>
bool has_memory_for(Action&& action) try {
  action();
  return true;
} catch (const std::bad_alloc&) {
  set_reason("there is too little memory for the rows of the matrix");
  return false;
}

}  // namespace buckens_petsc
