// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::body {

enum class SolverKind { direct, iterative, automatic };

/// Requested solver for the large systems of a mesh.
struct SolverChoice {
  SolverKind kind = SolverKind::direct;
  std::string petsc;  ///< options of PETSc; empty: those of linalg::IterativeSolver

  bool operator==(const SolverChoice&) const = default;
};

}  // namespace buckens::body
