// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <vector>

#include "mumps_factor.h"
#include "ranks.h"

namespace buckens_petsc {

enum class Task : int {
  make,
  factorise,
  solve,
  measure,
  release,
  divide,
  multiply,
  gather,
  forget,
  leave
};
constexpr int kMostMotions = 6;

/// What is to be done, the same on all processes.
struct Ranks::Order {
  Task task = Task::leave;
  int number = 0;  // of the solver or matrix
  int size = 0, block = 1, num_motions = 0, options = 0;
  union {
    BuckensGridLimits limits{};                // of a solve
    std::array<int, kBuckensMostProducts> of;  // matrices of products or of a sum, then −1
  };

  void set_matrices(const int* numbers, int count) {
    of.fill(-1);
    std::copy_n(numbers, count, of.begin());
  }
  int num_matrices() const {
    return static_cast<int>(std::find(of.begin(), of.end(), -1) - of.begin());
  }
};

/// A solver, and which rows of its matrix are here.
struct Ranks::Part {
  Solver solver;
  std::unique_ptr<MumpsFactor> factor;  // in place of a solver of PETSc's
  std::vector<int> first;               // rows of the processes, and the end
  std::vector<int> counts;
  std::vector<int> variables;  // of the factor, process after process; only the first has them
  std::vector<double> b, x, whole;

  bool is_direct() const { return factor != nullptr || solver.is_direct; }
  double bytes() const {
    return factor != nullptr ? sizeof(double) * factor->entries() : bytes_of(solver);
  }
};

/// A symmetric matrix of which the first process has nothing, and each other one a run of columns,
/// which are its rows.
struct Ranks::Divided {
  int size = 0;
  std::vector<int> first, counts;  // columns of the processes, and the end
  std::vector<int> starts, rows;   // of those here; rows are places in `variables`
  std::vector<double> values;
  std::vector<int> variables;  // ascending, those of which columns here have entries
  // Of the first process: `variables` of all, one process after the other.
  std::vector<int> lists, list_first, list_counts;
};

struct Ranks::Shared {
  std::map<int, std::unique_ptr<Part>> parts;  // by number
  std::map<int, std::unique_ptr<Divided>> matrices;
  std::vector<double> sent, received;  // by products
};

/// Rows of a symmetric matrix, which are its columns.
struct Ranks::OwnRows {
  BuckensGridColumns columns{};  // those below, or the first process's
  std::vector<int> starts, rows;
  std::vector<double> values, motions;
};

}  // namespace buckens_petsc
