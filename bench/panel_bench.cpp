// SPDX-License-Identifier: Apache-2.0
// Large solves over panels against CHOLMOD's own, with the same factor, and against the bound that
// the bandwidth of memory sets: every solve reads the factor twice.

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "solid_block.h"

#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/streaming_memory.h"

namespace {

using buckens::TaskPool;
using buckens::linalg::Matrix;
using buckens::linalg::SolveRoute;
using buckens::linalg::SparseCholesky;

// 2 997, 10 050, 30 375, 99 825 DOF; the last two make a cube of 30 000 and 300 000 DOF.
constexpr std::array<std::array<int, 3>, 6> kBlocks = {
    {{110, 2, 2}, {133, 4, 4}, {124, 8, 8}, {274, 10, 10}, {20, 20, 20}, {824, 10, 10}}};
constexpr int kLarge = 3;  // blocks up to this one are measured unless others are asked for

const buckens::linalg::SparseMatrix& matrix(int block) {
  static std::map<int, buckens::linalg::SparseMatrix> known;
  const auto found = known.find(block);
  if (found != known.end()) return found->second;
  known.clear();  // one at a time: the large ones need the memory
  const auto& divisions = kBlocks[static_cast<std::size_t>(block)];
  const Eigen::Vector3d size = divisions[0] == divisions[1] ? Eigen::Vector3d(0.1, 0.1, 0.1)
                                                            : Eigen::Vector3d(1.0, 0.1, 0.1);
  return known[block] = buckens::bench::step_matrix(buckens::bench::steel_block(divisions, size));
}

const SparseCholesky& factor(int block, SolveRoute route) {
  static std::map<std::pair<int, SolveRoute>, std::unique_ptr<SparseCholesky>> known;
  auto& entry = known[{block, route}];
  if (!entry) {
    const auto& A = matrix(block);
    known.clear();
    return *(known[{block, route}] =
                 std::make_unique<SparseCholesky>(A, buckens::linalg::CholeskyOptions{route}));
  }
  return *entry;
}

void report(benchmark::State& state, int block, const SparseCholesky& solver, int sides) {
  state.counters["dof"] = static_cast<double>(matrix(block).rows());
  state.counters["MB"] = 1e-6 * solver.bytes();
  state.counters["sides"] = sides;
  // Of reading the factor twice per solve.
  state.counters["GB/s"] = benchmark::Counter(
      2e-9 * solver.bytes() * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void factorise(benchmark::State& state, SolveRoute route) {
  const int block = static_cast<int>(state.range(0));
  const auto& A = matrix(block);
  for (auto _ : state) {
    const SparseCholesky solver(A, {route});
    benchmark::DoNotOptimize(solver.bytes());
  }
  state.counters["dof"] = static_cast<double>(A.rows());
}

void solve(benchmark::State& state, SolveRoute route) {
  const int block = static_cast<int>(state.range(0));
  const int sides = static_cast<int>(state.range(1));
  TaskPool pool(static_cast<int>(state.range(2)));
  const SparseCholesky& solver = factor(block, route);
  Matrix X = Matrix::Ones(solver.size(), sides);
  for (auto _ : state) {
    solver.solve_in_place(X, &pool);
    benchmark::DoNotOptimize(X.data());
    state.PauseTiming();
    X.setOnes();
    state.ResumeTiming();
  }
  report(state, block, solver, sides);
}

/// Reads memory that no cache holds, from one end to the other.
void read_memory(benchmark::State& state) {
  constexpr std::size_t kCount = std::size_t{1} << 27U;  // 1 GiB
  const int threads = static_cast<int>(state.range(0));
  static buckens::linalg::StreamingMemory memory(kCount);
  std::fill(memory.data(), memory.data() + kCount, 1.0);
  TaskPool pool(threads);
  std::array<double, 16> sums{};
  for (auto _ : state) {
    pool.run(threads, [&](int k) {
      const std::size_t share = kCount / static_cast<std::size_t>(threads);
      const double* values = memory.data() + share * static_cast<std::size_t>(k);
      std::array<double, 32> sum{};
      for (std::size_t i = 0; i < share; i += sum.size()) {
        for (std::size_t j = 0; j < sum.size(); j += 8) __builtin_prefetch(values + i + j + 512);
        for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += values[i + j];
      }
      for (const double part : sum) sums[static_cast<std::size_t>(k)] += part;
    });
    benchmark::DoNotOptimize(sums.data());
  }
  state.counters["GB/s"] = benchmark::Counter(
      8e-9 * static_cast<double>(kCount) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

void blocks(benchmark::internal::Benchmark* bench) {
  for (int block = 0; block <= kLarge; ++block) bench->Arg(block);
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

void solves(benchmark::internal::Benchmark* bench) {
  for (int block = 0; block < static_cast<int>(kBlocks.size()); ++block) {
    for (const int threads : {1, 2}) {
      for (const int sides : {1, 6, 32}) bench->Args({block, sides, threads});
    }
  }
  bench->ArgNames({"block", "sides", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(read_memory)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(factorise, panels, SolveRoute::panels)->Apply(blocks)->Iterations(1);
BENCHMARK_CAPTURE(solve, cholmod, SolveRoute::cholmod)->Apply(solves);
BENCHMARK_CAPTURE(solve, panels, SolveRoute::panels)->Apply(solves);

}  // namespace

BENCHMARK_MAIN();
