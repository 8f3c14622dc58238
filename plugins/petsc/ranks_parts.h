// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "mumps_factor.h"
#include "ranks.h"

namespace buckens_petsc {

enum class Task : int { make, factorise, solve, measure, release, leave };
constexpr int kMostMotions = 6;

/// What is to be done, the same on all processes.
struct Ranks::Order {
  Task task = Task::leave;
  int number = 0;  // of the solver
  int size = 0, block = 1, num_motions = 0, options = 0;
  BuckensGridLimits limits{};
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

struct Ranks::Shared {
  std::map<int, std::unique_ptr<Part>> parts;  // by number
};

/// Rows of a symmetric matrix, which are its columns.
struct Ranks::OwnRows {
  BuckensGridColumns columns{};  // those below, or the first process's
  std::vector<int> starts, rows;
  std::vector<double> values, motions;
};

}  // namespace buckens_petsc
