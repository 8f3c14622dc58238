// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/mesh_solver.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/iterative_solver.h"
#include "buckens/linalg/predicted_factor.h"
#include "buckens/linalg/ranks.h"

namespace buckens::body {

namespace {
constexpr double kGigabyte = 1e9;
}  // namespace

SolverDecision decide_solver(const SolverChoice& choice, const linalg::MatrixSum& A,
                             double memory) {
  if (choice.kind != SolverKind::automatic) return {choice.kind == SolverKind::iterative, {}};
  const double most = linalg::most_factor_bytes(A.size());
  if (most <= memory) {
    return {false, fmt::format("direct, since no factor of {} variables takes more than {:.3g} GB "
                               "(usable: {:.3g} GB)",
                               A.size(), most / kGigabyte, memory / kGigabyte)};
  }
  const linalg::PredictedFactor predicted = linalg::predict_factor(A);
  const std::string sizes = fmt::format(
      "the factor of {} variables is predicted to take {:.3g} GB, {:.3g} GB while it is computed "
      "(usable: {:.3g} GB)",
      A.size(), predicted.bytes / kGigabyte, predicted.peak / kGigabyte, memory / kGigabyte);
  if (predicted.peak <= memory) return {false, "direct, since " + sizes};
  const std::string missing = linalg::missing_grid_solver();
  if (missing.empty()) return {true, "iterative, since " + sizes};
  return {false, fmt::format("direct, although {}, since there is no iterative solver: {}", sizes,
                             missing)};
}

int variables_per_node(const fem::DofMap& dofs, Eigen::Index size) {
  if (dofs.node_dofs.empty() || dofs.num_dofs != size) return 1;
  const auto nodes = static_cast<int>(dofs.node_dofs.size());
  const int block = dofs.num_dofs / nodes;
  if (block * nodes != dofs.num_dofs) return 1;
  int next = 0;
  for (const auto& node : dofs.node_dofs) {
    int count = 0;
    for (const int dof : node) {
      if (dof < 0) continue;
      if (dof != next++) return 1;
      ++count;
    }
    if (count != block) return 1;
  }
  return block;
}

std::shared_ptr<const linalg::Factor> make_iterative(const FlexiblePart& part,
                                                     const linalg::MatrixSum& A) {
  linalg::IterationSettings settings;
  settings.block = variables_per_node(part.fe.dofs, A.size());
  settings.options = part.solver.petsc;
  return std::make_shared<const linalg::IterativeSolver>(A, part.sieve.Phi(), settings);
}

linalg::MakeFactor solver_of(const FlexiblePart& part) {
  if (part.solver.kind == SolverKind::direct) return linalg::make_large_factor;
  return [&part](const linalg::MatrixSum& A) -> std::shared_ptr<const linalg::Factor> {
    if (!decide_solver(part.solver, A).iterates) return linalg::make_large_factor(A);
    return make_iterative(part, A);
  };
}

}  // namespace buckens::body
