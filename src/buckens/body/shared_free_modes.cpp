// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/shared_free_modes.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/shift_search.h"
#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/shared_modes.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

IteratedModes shared_free_modes(const SymmetricMatrix& M, const SymmetricMatrix& K,
                                const Sieve& sieve, double first_shift, int count,
                                double tolerance) {
  ShiftSearch search(first_shift, highest_square(M, K));
  long solves = 0;
  const Matrix Phi = sieve.Phi();
  for (;;) {
    const double shift = search.shift();
    std::shared_ptr<const linalg::Factor> factor;
    ModeOperator op;  // the one that the search has, for vectors of this process
    try {
      op = sieved_operator(M, K, sieve, shift, [&factor](const linalg::MatrixSum& A) {
        return factor = linalg::make_large_factor(A);
      });
    } catch (const linalg::IndefiniteMatrix&) {
      if (!search.raise()) throw;
      continue;
    }
    linalg::InversePairs pairs;
    if (!factor->find_pairs({&K, &M, shift, &Phi, count, tolerance}, pairs)) {
      throw NumericalError("free vibration: the factor of this body is not one of processes");
    }
    solves += pairs.solves;
    if (!pairs.is_complete) {
      throw NumericalError(
          fmt::format("free vibration: the {} lowest modes did not converge in {} restarts of "
                      "SLEPc; ask for fewer modes or use the method subspace",
                      count, pairs.sweeps));
    }
    const Vector squares = (pairs.theta.cwiseInverse().array() - shift).cwiseMax(0.0);
    if (search.is_too_high(squares[0])) {
      search.lower(squares[0]);
      continue;
    }
    IteratedModes out;
    out.modes = {squares.cwiseSqrt(), std::move(pairs.shapes)};
    out.op = std::move(op);
    out.sweeps = pairs.sweeps;
    out.solves = solves;
    out.factorisations = search.attempt();
    return out;
  }
}

}  // namespace buckens::body
