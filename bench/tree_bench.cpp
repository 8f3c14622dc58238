// SPDX-License-Identifier: Apache-2.0
// How well the elimination tree of a factor can be shared among threads: what the busiest of 1 to
// 32 reads, the bounds on a solve that follow from it and from the bandwidth of memory, and the
// times of solves on as many threads as this machine has.
//
//     tree_bench hex8:31,31,31 [--budget SECONDS] [--threads MOST]
//
// Prints one JSON object. Times are the shortest of several [s].

#include <algorithm>
#include <cstring>
#include <iostream>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

#include "read_bandwidth.h"
#include "solid_block.h"
#include "stopwatch.h"

#include "buckens/base/allowed_threads.h"
#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace {

using buckens::TaskPool;
using buckens::bench::read_bandwidth;
using buckens::bench::shortest;
using buckens::bench::SolidBlock;
using buckens::linalg::Matrix;
using buckens::linalg::SparseCholesky;
using buckens::linalg::SparseMatrix;
using nlohmann::json;

json measure(const SolidBlock& block, double budget, int most_threads) {
  SparseMatrix A;
  {
    const auto fe = block.assembled();
    A = buckens::bench::step_matrix(fe);
  }
  const buckens::base::AllowedThreads allowed(most_threads);
  const SparseCholesky factor(A);
  json out = {{"element", block.element()},
              {"divisions", block.shape()},
              {"dof", A.rows()},
              {"bytes", factor.bytes()},
              {"parts", factor.num_parts()}};
  for (const int threads : {1, 2, 4, 8, 16, 32}) {
    json row = {{"threads", threads}, {"share", factor.busiest_share(threads)}};
    if (threads <= most_threads) {
      TaskPool pool(threads);
      Matrix x = Matrix::Ones(A.rows(), 1);
      factor.solve_in_place(x, &pool);  // makes room
      row["seconds"] = shortest(
          budget, [&] { factor.solve_in_place(x, &pool); }, [&] { x.setOnes(); });
      row["bandwidth"] = read_bandwidth(threads, budget);
    }
    out["by_threads"].push_back(row);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  buckens::linalg::choose_blas_kernels();
  double budget = 1.0;
  int most_threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::string block;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--budget") == 0 && k + 1 < argc) {
      budget = std::stod(argv[++k]);
    } else if (std::strcmp(argv[k], "--threads") == 0 && k + 1 < argc) {
      most_threads = std::stoi(argv[++k]);
    } else {
      block = argv[k];
    }
  }
  std::cout << measure(SolidBlock::parse(block), budget, most_threads).dump(1) << '\n';
}
