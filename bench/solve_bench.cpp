// SPDX-License-Identifier: Apache-2.0
// Factors and large solves over panels against CHOLMOD's, and solves against the bound that the
// bandwidth of memory sets: every solve reads the factor twice.
//
//     solve_bench hex8:274,10,10 [--budget SECONDS] [--no-reference]
//
// Prints one JSON object. Times are the shortest of several [s].

#include <cstring>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include "process_memory.h"
#include "read_bandwidth.h"
#include "solid_block.h"
#include "stopwatch.h"

#include "buckens/base/allowed_threads.h"
#include "buckens/base/free_memory.h"
#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace {

using buckens::TaskPool;
using buckens::bench::read_bandwidth;
using buckens::bench::shortest;
using buckens::bench::SolidBlock;
using buckens::bench::Stopwatch;
using buckens::linalg::Matrix;
using buckens::linalg::SolveRoute;
using buckens::linalg::SparseCholesky;
using buckens::linalg::SparseMatrix;
using nlohmann::json;

/// Times of solves with 1, 6, 32 right-hand sides on one or two threads.
json solve_times(const SparseCholesky& solver, int threads, double budget) {
  TaskPool pool(threads);
  json out;
  for (const int sides : {1, 6, 32}) {
    Matrix X = Matrix::Ones(solver.size(), sides);
    solver.solve_in_place(X, &pool);  // makes room
    out[std::to_string(sides)] = shortest(
        budget, [&] { solver.solve_in_place(X, &pool); }, [&] { X.setOnes(); });
  }
  return out;
}

/// ‖A x − b‖ / ‖b‖.
double residual(const SparseMatrix& A, const SparseCholesky& solver) {
  const Matrix b = Matrix::Random(A.rows(), 1);
  const Matrix x = solver.solve(b);
  return (A * x - b).norm() / b.norm();
}

json measure(const SolidBlock& block, double budget, bool with_reference) {
  json out;
  Stopwatch assembly;
  SparseMatrix A;
  {
    const auto fe = block.assembled();
    A = buckens::bench::step_matrix(fe);
  }
  out["element"] = block.element();
  out["divisions"] = block.shape();
  out["slender"] = block.is_slender();
  out["dof"] = A.rows();
  out["assembly"] = assembly.seconds();
  if (with_reference) {
    const Stopwatch factorisation;
    const SparseCholesky reference(A, {SolveRoute::cholmod});
    out["cholmod"] = {{"factorisation", factorisation.seconds()},
                      {"entries", reference.num_factor_entries()},
                      {"bytes", reference.bytes()},
                      {"residual", residual(A, reference)},
                      {"1", solve_times(reference, 1, budget)}};
    buckens::base::return_free_memory();
  }
  for (const int threads : {2, 1}) {
    const buckens::base::AllowedThreads allowed(threads);
    const Stopwatch factorisation;
    const SparseCholesky factor(A);
    out["factorisation"][std::to_string(threads)] = factorisation.seconds();
  }
  const double before = buckens::bench::restart_peak();
  const SparseCholesky solver(A);
  out["factor_bytes"] = buckens::bench::process_memory("VmHWM") - before;
  out["entries"] = solver.num_factor_entries();
  out["panels"] = {{"bytes", solver.bytes()},
                   {"parts", solver.num_parts()},
                   {"residual", residual(A, solver)},
                   {"1", solve_times(solver, 1, budget)},
                   {"2", solve_times(solver, 2, budget)}};
  out["peak_bytes"] =
      buckens::bench::process_memory("VmHWM");  // before a gigabyte to read is added
  out["bandwidth"] = {{"1", read_bandwidth(1, budget)}, {"2", read_bandwidth(2, budget)}};
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  buckens::linalg::choose_blas_kernels();
  double budget = 1.0;
  bool with_reference = true;
  std::string block;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--budget") == 0 && k + 1 < argc) {
      budget = std::stod(argv[++k]);
    } else if (std::strcmp(argv[k], "--no-reference") == 0) {
      with_reference = false;
    } else {
      block = argv[k];
    }
  }
  std::cout << measure(SolidBlock::parse(block), budget, with_reference).dump(1) << '\n';
}
