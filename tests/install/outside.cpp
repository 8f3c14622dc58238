// SPDX-License-Identifier: Apache-2.0
// Uses the installed package the way a stranger's program would: headers, own code, and through it
// every library the package has to find again (CHOLMOD, OpenBLAS, muParser, HDF5).
#include <cmath>
#include <cstdio>
#include <cstring>

#include "buckens/base/errors.h"
#include "buckens/base/time_law.h"
#include "buckens/base/version.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/run_store/run_reader.h"

namespace {

bool factor_solves() {
  buckens::linalg::SparseMatrix A(3, 3);
  A.setIdentity();
  A *= 4.0;
  const buckens::linalg::SparseCholesky factor(A);
  buckens::linalg::Vector x = buckens::linalg::Vector::Constant(3, 2.0);
  factor.solve_in_place(x);
  return (x.array() - 0.5).abs().maxCoeff() < 1e-15;  // exact in binary
}

bool missing_run_is_refused() {
  try {
    const buckens::run_store::RunReader reader("no-such-run");
  } catch (const buckens::IoError&) {
    return true;
  }
  return false;
}

}  // namespace

int main() {
  const bool law_holds = buckens::base::TimeLaw::constant(2.0).value(1.0) == 2.0;
  if (!law_holds || !factor_solves() || !missing_run_is_refused() ||
      std::strlen(buckens::kVersion) == 0) {
    std::puts("the installed library answers wrongly");
    return 1;
  }
  std::printf("outside project runs with buckens %s\n", buckens::kVersion);
  return 0;
}
