// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"
#include "buckens/body/solver_choice.h"

namespace buckens::body {

constexpr std::array<const char*, 3> choice_names(SolverKind) {
  return {"direct", "iterative", "auto"};
}

/// Solver for the large systems of the body's mesh.
struct SolverSpec {
  SourceLocation where;
  std::optional<SolverKind> kind;
  std::string petsc;

  SolverChoice choice() const {
    return {kind.value_or(petsc.empty() ? SolverKind::direct : SolverKind::iterative), petsc};
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("kind", kind,
                      "direct: by a factor, which is quick and takes memory; iterative: by "
                      "conjugate gradients with multigrid, for bodies whose factor does not fit; "
                      "auto: by a factor if its predicted memory is at most half of the machine's")
              .shorthand()
              .like("iterative")
              .otherwise("`direct`, or `iterative` where there is `petsc`"));
    visit(base::field("petsc", petsc,
                      "options of PETSc for the iteration, as on the command line of a program of "
                      "PETSc; they override those of Buckens")
              .like("\"-pc_type hypre -pc_hypre_type boomeramg\"")
              .otherwise("multigrid by GAMG"));
  }
};

}  // namespace buckens::body
